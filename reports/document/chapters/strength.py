"""Chapter on the strength of piston, ring, pin, rod, bolts and webs."""

from __future__ import annotations

import math
from functools import partial

from markupsafe import Markup

from kshm.defaults import PART_SHARES
from reports.document.chapters.chapter import Chapter
from reports.document.figures.parts import parts_sketch
from reports.document.page.blocks import TableBlock, TableColumn, grid_table, table_block
from reports.document.page.numbering import Figure, TablePlan
from reports.document.text.symbols import titled_html
from reports.document.text.terms import Terms, material_name
from reports.document.text.texts import limits
from reports.inputs.sections.strength import PART_MATERIALS
from reports.model.blocks import Scalar, ScalarTable
from reports.shared.russian import NBSP, capital, fixed, joined, uncapital

_LISTS = {
    "loads": ("strength_loads", "Силы, по которым рассчитана прочность"),
    "piston": ("strength_piston", "Результаты расчёта поршня"),
    "ring": ("strength_ring", "Результаты расчёта поршневого кольца"),
    "pin": ("strength_pin", "Результаты расчёта поршневого пальца"),
    "eye": ("strength_eye", "Результаты расчёта верхней головки шатуна"),
    "shank": ("strength_shank", "Результаты расчёта стержня шатуна"),
    "cap": ("strength_cap", "Результаты расчёта крышки шатуна и болтов"),
}
# What mends a value above its usual limits, by the check of ``strength.book``.
_MENDS = {
    "crown": "увеличить толщину днища",
    "press": "увеличить толщину стенки головки поршня",
    "pull": "увеличить толщину стенки головки поршня",
    "land": "увеличить высоту перемычки",
    "q1": "удлинить юбку",
    "q2": "увеличить высоту поршня",
    "ring": "уменьшить разность зазоров замка",
    "ring_work": "уменьшить разность зазоров замка",
    "pin_eye": "удлинить втулку шатуна или увеличить диаметр пальца",
    "pin_boss": "удлинить палец или увеличить его диаметр",
    "pin_bend": "увеличить диаметр пальца или толщину его стенки",
    "pin_shear": "увеличить диаметр пальца или толщину его стенки",
    "oval": "увеличить толщину стенки пальца",
    "oval_in0": "увеличить толщину стенки пальца",
    "bush_in": "уменьшить натяг втулки",
    "cap": "увеличить длину нижней головки или расстояние между болтами",
    "eye_top": "увеличить наружный диаметр верхней головки",
    "eye": "увеличить наружный диаметр верхней головки",
    "shank": "увеличить сечение стержня или взять сталь прочнее",
    "bolt": "увеличить диаметр болта",
    "web": "увеличить ширину или толщину щеки, взять сталь прочнее",
}
_RANGED = 2  # decimals of values beside their usual limits
_SPARE = "взято с запасом"  # of a value below the usual
_USUAL_BORE_MM = 160  # of cars, lorries and tractors, which the usual limits are of


def strength(chapter: Chapter) -> Markup:
    """Loads, sizes, each part with its formulas, usual ranges, safety."""
    section = chapter.input.strength
    if section is None:
        return Markup("")
    terms = chapter.terms
    tables = {
        name: chapter.scalars(caption, [scalar.key for scalar in _block(chapter, block).scalars])
        for name, (block, caption) in _LISTS.items()
    }
    tables["sizes"] = TablePlan(partial(_sizes, terms, _block(chapter, "strength_sizes")),
                                "Размеры частей")  # fmt: skip
    tables["ranges"] = TablePlan(partial(_ranges, terms, _block(chapter, "strength_ranges")),
                                 "Напряжения и обычные пределы")  # fmt: skip
    if terms.has("st_web_n"):
        webs = chapter.grid("strength_webs")
        tables["webs"] = TablePlan(partial(grid_table, terms, webs), "Запасы прочности щёк")
    return chapter.page(
        "strength",
        section=section,
        tables=tables,
        sketch=Figure(partial(parts_sketch, _drawn(chapter)),
                      f"Размеры частей: а{NBSP}— поршень; б{NBSP}— палец; в{NBSP}— шатун"),
        estimated=any(getattr(section, f"{key}_mm") is None for key in PART_SHARES),
        cold=min(terms.value("st_hot_head_mm"), terms.value("st_hot_skirt_mm")) < 0,
        outside=_outside(chapter),
        weak=_weak(chapter),
        mends=_MENDS,
        large=_bore_mm(terms) > _USUAL_BORE_MM,
        webs=terms.has("st_web_n"),
        rod=material_name(PART_MATERIALS[section.rod_material].label),
        bolt=material_name(PART_MATERIALS[section.bolt_material].label),
        web=material_name(PART_MATERIALS[section.web_material].label),
        joined=joined,
    )  # fmt: skip


def concluded(chapter: Chapter) -> Markup:
    """The chapter's result in a line of the conclusion."""
    if chapter.input.strength is None:
        return Markup("")
    terms, block = chapter.terms, _block(chapter, "strength_allowed")
    allowed = terms.num("strength_safety_allowed")
    least = min((value for value, _ in _pairs(block)), key=lambda each: terms.value(each.key))
    side = "меньше" if _weak(chapter) else "не меньше"
    line = Markup("наименьший запас прочности деталей {} — {}, он {} допускаемого {}").format(
        fixed(terms.value(least.key), 2), titled_html(uncapital(least.note)), side, allowed
    )
    outside = [name for name, mend in _outside(chapter) if mend != _SPARE]
    if outside:
        line += Markup("; больше обычных пределов: {}").format(joined(outside))
    return line


def _block(chapter: Chapter, name: str) -> ScalarTable:
    return next(block for block in chapter.model.blocks
                if isinstance(block, ScalarTable) and block.id == name)  # fmt: skip


def _pairs(block: ScalarTable) -> list[tuple[Scalar, Scalar]]:
    """Values with their verdicts."""
    return list(zip(block.scalars[::2], block.scalars[1::2], strict=True))


def _outside(chapter: Chapter) -> list[tuple[str, str]]:
    """Values outside of their usual limits, each with what mends it."""
    parts = []
    for value, verdict in _pairs(_block(chapter, "strength_ranges")):
        if chapter.terms.values.scalars[verdict.key] == "в пределах":
            continue
        low = value.note.partition("обычно ")[2].partition("…")[0].replace(",", ".")
        is_low = abs(chapter.terms.value(value.key)) < abs(float(low.replace("−", "-")))
        mend = _SPARE if is_low else _MENDS[value.key.removeprefix("value_range_")]
        parts.append((uncapital(value.note.partition(":")[0]), mend))
    return parts


def _weak(chapter: Chapter) -> list[tuple[str, str]]:
    """Parts whose safety is less than allowed, each with what mends it."""
    values = chapter.terms.values.scalars
    return [(uncapital(value.note), _MENDS[value.key.removeprefix("value_st_")])
            for value, verdict in _pairs(_block(chapter, "strength_allowed"))
            if values[verdict.key] == "НЕТ"]  # fmt: skip


def _sizes(terms: Terms, block: ScalarTable) -> TableBlock:
    """Sizes with where each is from."""
    rows = [
        [titled_html(capital(scalar.quantity.title)), terms.sym(scalar.key), terms.num(scalar.key),
         titled_html(scalar.source.partition(" (")[0])]
        for scalar in block.scalars
    ]  # fmt: skip
    return table_block(
        [TableColumn("Размер, мм", 4.2, text=True), TableColumn("Обозначение", 1.6),
         TableColumn("Значение", 1.4), TableColumn("Основание", 2.4, text=True)], rows,
    )  # fmt: skip


def _ranges(terms: Terms, block: ScalarTable) -> TableBlock:
    rows = []
    for value, verdict in _pairs(block):
        title, _, usual = value.note.partition(": обычно ")
        shown = fixed(terms.value(value.key), _RANGED)
        rows.append(
            [titled_html(title), shown, limits(usual), str(terms.values.scalars[verdict.key])]
        )
    return table_block(
        [TableColumn("Величина", 4.2, text=True), TableColumn("Значение", 1.4),
         TableColumn("Обычно", 1.8), TableColumn("Вывод", 1.8)], rows,
    )  # fmt: skip


def _drawn(chapter: Chapter) -> dict[str, float]:
    """Sizes for the sketch."""
    values = chapter.terms.values.scalars
    sizes = {key: float(values[f"st_{key}_mm"]) for key in PART_SHARES}
    bore = _bore_mm(chapter.terms)
    crankpin = 2 * (sizes["bolts_apart"] / 2 - float(values["st_cap_wall_mm"]) - sizes["shell"])
    return sizes | {"bore": bore, "crankpin": crankpin}


def _bore_mm(terms: Terms) -> float:
    return 1000 * math.sqrt(4 * float(terms.values.scalars["F_piston"]) / math.pi)
