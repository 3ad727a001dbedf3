"""The chapters of the report, in its order."""

from __future__ import annotations

from reports.document.chapters import (
    balance,
    closing,
    counterweights,
    cycle,
    dynamics,
    journals,
    oil,
    opening,
    own,
    rationale,
    regimes,
    strength,
    torsion,
)
from reports.document.chapters.record import Record, central
from reports.tables.cycle_members import section_of

_FORCES = "силы и моменты, действующие в нём за рабочий цикл"
_LOADS = "нагрузки на шейки коленчатого вала"
_OIL = "толщину масляной плёнки подшипников и запасы прочности шеек"

CHAPTERS: tuple[Record, ...] = (
    Record("notation", opening.notation, "always"),
    Record("introduction", opening.introduction, "always"),
    Record("inputs", opening.input_data, "always"),
    Record("rationale", rationale.rationale, conclude=rationale.concluded),
    Record("cycle", cycle.cycle, "short", applies=lambda model: section_of(model) is not None,
           keywords=("рабочий цикл",), aim="показатели рабочего цикла",
           findings=("показатели рабочего цикла",)),
    Record("kinematics", dynamics.kinematics, "short", keywords=("кинематика",),
           aim="движение деталей механизма",
           findings=("перемещение, скорость и ускорение поршня", "качание шатуна")),
    Record("dynamics", dynamics.dynamics, "short",
           keywords=("динамика", "индикаторная диаграмма"), aim=_FORCES,
           findings=("силы в механизме",)),
    Record("torque", dynamics.torque, "short", keywords=("крутящий момент",), aim=_FORCES,
           findings=("крутящий момент двигателя",)),
    Record("crankpin", journals.crankpin, "short",
           keywords=("шатунная шейка", "диаграмма износа"), aim=_LOADS,
           findings=("нагрузка на шатунную шейку и условная диаграмма её износа",)),
    Record("journals", journals.journals, "short", keywords=("коренная шейка",), aim=_LOADS,
           findings=("нагрузки на коренные шейки и их условные диаграммы износа",)),
    Record("bearings", journals.bearings, "full", conclude=journals.concluded, aim=_LOADS,
           keys=("Malpha", "B_")),
    Record("running", dynamics.running, aim=_LOADS, findings=("набегающие моменты",),
           keys=("dM_",)),
    Record("balance", balance.balance, applies=central, conclude=balance.concluded,
           keywords=("уравновешенность",), sections=("balance",),
           aim="уравновешенность и неравномерность хода двигателя",
           findings=("уравновешенность и неравномерность хода двигателя",),
           keys=("I_flywheel", "W_range")),
    Record("counterweights", counterweights.counterweights,
           applies=lambda model: model.counterweight is not None,
           conclude=counterweights.concluded, keywords=("противовесы",),
           sections=("counterweight",), aim="противовесы щёк",
           findings=("доля, угол и масса противовесов",)),
    Record("torsion", torsion.torsion, applies=lambda model: model.torsion is not None,
           conclude=torsion.concluded, keywords=("крутильные колебания",), sections=("torsion",),
           aim="крутильные колебания вала", findings=("крутильные колебания вала",)),
    Record("oil", oil.oil, applies=lambda model: model.bearings is not None,
           conclude=oil.concluded, keywords=("масляная плёнка",), sections=("bearings",),
           aim=_OIL, findings=(_OIL.replace("толщину", "толщина"),)),
    Record("strength", strength.strength, applies=lambda model: model.strength is not None,
           conclude=strength.concluded, keywords=("прочность деталей",), sections=("strength",),
           aim="прочность деталей", findings=("прочность деталей",)),
    Record("own", own.own, applies=lambda model: bool(model.books)),
    Record("regimes", regimes.regimes, conclude=regimes.concluded),
    Record("reference", dynamics.reference, "full", sections=("reference",)),
    Record("companions", balance.companions, "full", applies=central),
    Record("checks", closing.checks, "short"),
    Record("conclusion", closing.conclusion, "always"),
    Record("sources", closing.sources, "always"),
    Record("appendices", closing.appendices),
)  # fmt: skip
