"""Registry of the sections of the input file in their order."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from reports.inputs.meta import StrictModel, hints
from reports.inputs.sections.bearings import BearingsSection
from reports.inputs.sections.counterweight import CounterweightSection
from reports.inputs.sections.flywheel import FlywheelSection
from reports.inputs.sections.gas import (
    CycleGasSection,
    CycleSection,
    PolytropicGasSection,
    RoundedGasSection,
    TableGasSection,
)
from reports.inputs.sections.input_file import (
    Calculation,
    EngineSection,
    GeometrySection,
    PrototypeSection,
    Regime,
)
from reports.inputs.sections.mechanism import (
    ArticulatedSection,
    BalanceSection,
    CrankshaftSection,
    MassesSection,
)
from reports.inputs.sections.report import (
    ChecksSection,
    ReferenceSection,
    ReportSection,
    SheetSection,
    WorkbookSection,
)
from reports.inputs.sections.strength import StrengthSection
from reports.inputs.sections.torsion import TorsionSection


@dataclass(frozen=True, slots=True)
class ListKey:
    """A list of a section: its Russian title and the names of its cells."""

    title: str
    cells: str  # {n} is the number of the entry, {key} the key within a record


@dataclass(frozen=True, slots=True)
class InputSection:
    """A section of the input file.

    Attributes:
        name: Its name in the file.
        title: Russian title.
        model: Its model; that of its usual source where there are several.
        optional: It may be left out: then its defaults hold, or it is absent.
        absent: Left out it is None: an alternative, shown as comments in a new file.
        sources: Models by the key ``source``.
        lists: Its lists by key.
        words: Lines told above it in a new file.
    """

    name: str
    title: str
    model: type[StrictModel]
    optional: bool = False
    absent: bool = False
    sources: Mapping[str, type[StrictModel]] = field(default_factory=dict)
    lists: Mapping[str, ListKey] = field(default_factory=dict)
    words: tuple[str, ...] = ()

    @property
    def models(self) -> tuple[type[StrictModel], ...]:
        """Every model that the section may have."""
        return tuple(self.sources.values()) or (self.model,)


_ALL = (
    InputSection(
        "report",
        "Сведения о работе",
        ReportSection,
        optional=True,
        lists={
            "chapters": ListKey("Главы отчёта", "report_chapter_{n}"),
            "formats": ListKey("Документы", "report_format_{n}"),
            "books": ListKey("Свои книги расчётов", "report_book_{n}"),
        },
    ),
    InputSection("engine", "Двигатель", EngineSection),
    InputSection("calculation", "Расчёт", Calculation, optional=True),
    InputSection("geometry", "Геометрия", GeometrySection),
    InputSection("regime", "Режим", Regime),
    InputSection(
        "gas",
        "Газы",
        PolytropicGasSection,
        sources={
            "polytropic": PolytropicGasSection,
            "table": TableGasSection,
            "cycle": CycleGasSection,
            "rounded": RoundedGasSection,
        },
        lists={"points": ListKey("Индикаторная диаграмма по точкам", "gas_point_{n}_{key}")},
        words=(
            'source = "rounded" — скруглённая диаграмма рисунка 22 (kind = "petrol" или "diesel");',
            'source = "table" — точки points, interpolation = "linear" или "monotone";',
            'source = "file" — текстовая таблица рядом с этим файлом (CSV или результаты',
            'DIESEL-RK, сохранённые как текст): file = "diagram.csv", pressure_unit = "bar",',
            "angle_column и pressure_column — номер или заголовок столбца, firing_tdc_deg — угол",
            "ВМТ сгорания в таблице.",
            "Другие режимы того же двигателя — разделы [[regimes]] с [regimes.gas]: см. образец",
            "gots-regimes.",
        ),
    ),
    InputSection(
        "cycle",
        "Рабочий цикл",
        CycleSection,
        optional=True,
        absent=True,
        words=(
            'Давления газов можно взять из расчёта цикла: gas.source = "cycle" и раздел [cycle];',
            "готовый пример даёт команда kshm new --sample cycle-turbo-diesel.",
        ),
    ),
    InputSection(
        "masses",
        "Массы",
        MassesSection,
        words=(
            "Шатун: rod_centre_mm, или rod_small_end_share, или взвешивание",
            "rod_weighed_small_end_kg, или качания; чего нет — оценит estimate_fuel по таблице 4.",
        ),
    ),
    InputSection(
        "articulated",
        "Прицепной шатун",
        ArticulatedSection,
        optional=True,
        absent=True,
        words=("Если шатуны правого ряда V-образного двигателя висят на главных:",),
    ),
    InputSection(
        "crankshaft",
        "Коленчатый вал",
        CrankshaftSection,
        lists={
            "firing_offsets_deg": ListKey("Начало рабочих ходов", "firing_offset_{n}_deg"),
            "throw_angles_deg": ListKey("Углы колен", "throw_angle_{n}_deg"),
            "force_offsets_deg": ListKey("Фазы сил", "force_offset_{n}_deg"),
            "pin_diameters_mm": ListKey("Диаметры шатунных шеек", "pin_diameter_{n}_mm"),
            "pin_lengths_mm": ListKey("Длины шатунных шеек", "pin_length_{n}_mm"),
            "main_diameters_mm": ListKey("Диаметры коренных шеек", "main_diameter_{n}_mm"),
            "main_lengths_mm": ListKey("Коренные шейки", "main_length_{n}_mm"),
            "webs": ListKey("Щёки и противовесы", "web_{n}_{key}"),
            "arms": ListKey("Плечи колен", "throw_{n}_{key}"),
        },
    ),
    InputSection("balance", "Уравновешивание и маховик", BalanceSection, optional=True),
    InputSection(
        "flywheel",
        "Маховик как деталь",
        FlywheelSection,
        optional=True,
        absent=True,
        words=(
            "Раздел [flywheel] находит размеры маховика по требуемому моменту инерции: диск,",
            "обод, массу, скорость обода рядом с допускаемой. Все ключи необязательны.",
        ),
    ),
    InputSection(
        "counterweight",
        "Подбор противовесов",
        CounterweightSection,
        optional=True,
        absent=True,
        words=(
            "Раздел [counterweight] подбирает противовесы щёк: долю вращающихся масс по нагрузке",
            "коренных шеек или по остатку первого порядка, угол и массу сектора. Все ключи",
            "необязательны: размер, которого нет, следует из размеров механизма.",
        ),
    ),
    InputSection(
        "torsion",
        "Крутильные колебания",
        TorsionSection,
        optional=True,
        absent=True,
        lists={
            "throws_kg_m2": ListKey("Моменты инерции колен", "torsion_throw_{n}_kg_m2"),
            "throws_nm_rad": ListKey("Жёсткости за коленами", "torsion_throw_{n}_nm_rad"),
            "masses": ListKey("Заданная крутильная схема", "torsion_mass_{n}_{key}"),
            "peaks": ListKey("Наибольшее давление по частоте вращения", "torsion_peak_{n}_{key}"),
        },
        words=(
            "Раздел [torsion] добавляет крутильные колебания вала. Все ключи необязательны: чего",
            "нет, то оценено по остальным данным и названо оценкой. Готовую схему из 2–20 масс",
            "задают записи [[torsion.masses]], пример — образец mwm-6.",
        ),
    ),
    InputSection(
        "bearings",
        "Подшипники и прочность шеек",
        BearingsSection,
        optional=True,
        absent=True,
        words=(
            "Раздел [bearings] добавляет масляную плёнку подшипников и запасы прочности шеек. Все",
            "ключи необязательны: чего нет, то принято по правилу, названному в книге.",
        ),
    ),
    InputSection(
        "strength",
        "Прочность поршня, пальца, шатуна и щёк",
        StrengthSection,
        optional=True,
        absent=True,
        words=(
            "Раздел [strength] добавляет прочность поршня, кольца, пальца, шатуна, болтов и щёк.",
            "Все ключи необязательны: размер, которого нет, взят по обычному отношению.",
        ),
    ),
    InputSection(
        "reference",
        "Справочные таблицы",
        ReferenceSection,
        optional=True,
        absent=True,
        lists={"lambdas": ListKey("Справочные таблицы: значения λ", "reference_lambda_{n}_value")},
        words=("Таблицы 1–3, 5–8 и рисунки 3–10 учебника для любых λ; lambdas — список:",),
    ),
    InputSection(
        "prototype",
        "Прототип",
        PrototypeSection,
        optional=True,
        absent=True,
        words=(
            "Раздел [prototype] ставит рядом с двигателем прототип в главе об исходных данных:",
            'его главные числа или file = "прототип.toml" — его файл исходных данных.',
        ),
    ),
    InputSection(
        "sheet",
        "Лист динамики",
        SheetSection,
        optional=True,
        absent=True,
        lists={"diagrams": ListKey("Лист динамики", "sheet_diagram_{n}")},
        words=("Лист A1 или A2 с диаграммами: kshm build --only sheet (PDF и DXF):",),
    ),
    InputSection("workbook", "Состав книги", WorkbookSection, optional=True),
    InputSection(
        "checks",
        "Принятые расхождения",
        ChecksSection,
        optional=True,
        absent=True,
        lists={"accepted": ListKey("Принятые расхождения", "accepted_{n}_{key}")},
        words=(
            "Что необычно или не сходится, но так и должно быть: what — ключ из предупреждения",
            '(например, geometry.bore_mm) или имя проверки ("power"), reason — причина. Она',
            "будет названа в книге и в отчёте, а код завершения останется 0:",
        ),
    ),
)
SECTIONS: dict[str, InputSection] = {section.name: section for section in _ALL}
GAS_MODELS = SECTIONS["gas"].sources


def records(model: type[StrictModel]) -> Iterator[tuple[str, type[StrictModel]]]:
    """Keys of a model that hold lists of records, with the records' models."""
    for key, spec in hints(model).items():
        if spec.inner is not None:
            yield key, spec.inner


def homes() -> Iterator[tuple[str, tuple[type[StrictModel], ...]]]:
    """Headings of the file with the models of their keys."""
    for section in SECTIONS.values():
        yield f"[{section.name}]", section.models
        for key, inner in records(section.model):
            yield f"[[{section.name}.{key}]]", (inner,)
