"""Chapter on the strength of piston, ring, pin, rod, bolts and webs."""

from __future__ import annotations

import math
from functools import partial

from markupsafe import Markup

from kshm.nomenclature.quantity import quantity
from kshm.ranges import PART_SHARES
from reports.document.chapters.chapter import Chapter
from reports.document.chapters.strength_changes import ChangedSizes, changed
from reports.document.figures.parts import parts_sketch
from reports.document.page.blocks import (
    TableBlock,
    TableColumn,
    grid_table,
    symbol_head,
    table_block,
)
from reports.document.page.numbering import Figure, TablePlan
from reports.document.text.symbols import titled_html
from reports.document.text.terms import Terms, material_name, plain_number
from reports.document.text.texts import limits
from reports.inputs.sections.strength import PART_MATERIALS
from reports.inputs.to_si.engine import to_engine
from reports.model.blocks import Scalar, ScalarTable
from reports.shared.russian import NBSP, capital, fixed, joined, uncapital
from reports.tables.strength_members import SAFETIES, UsualStress, usual_stresses

_LISTS = {
    "loads": ("strength_loads", "Силы, по которым рассчитана прочность"),
    "piston": ("strength_piston", "Результаты расчёта поршня"),
    "ring": ("strength_ring", "Результаты расчёта поршневого кольца"),
    "pin": ("strength_pin", "Результаты расчёта поршневого пальца"),
    "eye": ("strength_eye", "Результаты расчёта верхней головки шатуна"),
    "shank": ("strength_shank", "Результаты расчёта стержня шатуна"),
    "cap": ("strength_cap", "Результаты расчёта крышки шатуна и болтов"),
}
# What mends a safety below the allowed one, by the key of ``strength.book``.
_MENDS = {
    "st_eye_top": "увеличить наружный диаметр верхней головки",
    "st_eye": "увеличить наружный диаметр верхней головки",
    "st_shank": "увеличить сечение стержня или взять сталь прочнее",
    "st_bolt": "увеличить диаметр болта",
    "st_web": "увеличить ширину или толщину щеки, взять сталь прочнее",
}
_SIDES = {-1: "меньше", 0: "в пределах", 1: "больше"}
_LIMITS = ("tensile", "yield", "bend", "pull", "turn", "modulus")  # columns of the materials
_RANGED = 2  # decimals of values beside their usual limits
_MOVED = 1e-3  # of a value: what changes less is not told again
_SIZE_NAMES = {"bush_fit": "strength_bush_fit_um"}
_SPARE = "взято с запасом"  # of a value below the usual
_USUAL_BORE_MM = 160  # of cars, lorries and tractors, which the usual limits are of


def strength(chapter: Chapter) -> Markup:
    """Return loads, sizes, each part with its formulas, usual ranges, safety."""
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
    tables["ranges"] = TablePlan(partial(_ranges, chapter), "Напряжения и обычные пределы")
    tables["materials"] = TablePlan(partial(_materials, chapter), "Материалы деталей")
    made = _changed(chapter)
    if made is not None:
        tables["changes"] = TablePlan(partial(_changes, terms, made), "Изменение размеров",
                                      keep=True)  # fmt: skip
        tables["again"] = TablePlan(
            partial(_again, chapter, made), "Напряжения и запасы с изменёнными размерами", keep=True
        )
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
        made=made,
        left=[] if made is None else [_title_of(chapter, key) for key in made.left],
        crown=_crown(chapter) if made and any(c.key == "crown" for c in made.changes) else "",
        exchange=terms.has("st_Pg_tdc_N"),
        web=_weakest_web(terms, chapter.shape.throws),
        large=_bore_mm(terms) > _USUAL_BORE_MM,
        webs=terms.has("st_web_n"),
    )  # fmt: skip


def concluded(chapter: Chapter) -> Markup:
    """Return the chapter's result in a line of the conclusion."""
    if chapter.input.strength is None:
        return Markup("")
    terms, block = chapter.terms, _block(chapter, "strength_allowed")
    allowed = terms.num("strength_safety_allowed")
    least = min((value for value, _ in _pairs(block)), key=lambda each: terms.value(each.key))
    side = "меньше" if _weak(chapter) else "не меньше"
    line = Markup("наименьший запас прочности деталей {} — {}, он {} допускаемого {}").format(
        fixed(terms.value(least.key), 2), titled_html(uncapital(least.note)), side, allowed
    )
    above = [uncapital(each.title) for each, _, side in _ranged(chapter) if side > 0]
    if above:
        line += Markup("; больше обычных пределов: {}").format(joined(above))
    return line


def _changed(chapter: Chapter) -> ChangedSizes | None:
    """Sizes with which all is within its limits, where something is not."""
    above = any(side > 0 for _, _, side in _ranged(chapter))
    if not (above or _weak(chapter)):
        return None
    section = chapter.input.strength
    assert section is not None
    made = changed(to_engine(chapter.input), usual_stresses(section), section.safety_allowed)
    return made if made.changes else None


def _crown(chapter: Chapter) -> str:
    """Thickness of the crown from its formula backwards, as TeX with numbers."""
    terms, limit = chapter.terms, next(each for each, _, _ in _ranged(chapter)
                                       if each.key == "st_crown_MPa")  # fmt: skip
    inner, peak = terms.value("st_inner_mm"), terms.value("st_pz_MPa")
    least = inner / 2 * math.sqrt(peak / limit.high)
    numbers = [fixed(inner, 2), fixed(peak, 3), fixed(limit.high, 0)]
    symbols = [
        terms.tex(key) for key in ("st_crown_mm", "st_inner_mm", "st_pz_MPa", "st_crown_MPa")
    ]
    root = r"\dfrac{{{}}}{{2}} \cdot \sqrt{{\dfrac{{{}}}{{{}}}}}".format
    limited = rf"\left[{symbols[3]}\right]"
    said = [number.replace(",", "{,}") for number in (*numbers, fixed(least, 2))]
    formula = rf"{symbols[0]} \geq {root(*symbols[1:3], limited)}".replace(r" \cdot ", "")
    return rf"{formula} = {root(*said[:3])} = {said[3]}\ \mathrm{{мм}}"


def _title_of(chapter: Chapter, key: str) -> str:
    titles = {each.key: uncapital(each.title) for each, _, _ in _ranged(chapter)}
    return titles.get(key) or chapter.terms.title(key)


def _changes(terms: Terms, made: ChangedSizes) -> TableBlock:
    """Sizes before and after [mm]."""
    rows = []
    for each in made.changes:
        name = _SIZE_NAMES.get(each.key, f"st_{each.key}_mm")
        unit = terms.unit(name)
        scale = 1e6 if each.key in _SIZE_NAMES else 1e3
        rows.append([titled_html(capital(terms.title(name))), terms.sym(name),
                     *(plain_number(round(scale * size, 3)) for size in (each.before, each.after)),
                     unit])  # fmt: skip
    return table_block(
        [TableColumn("Размер", 4.2, text=True), TableColumn("Обозначение", 1.6),
         TableColumn("Было", 1.4), TableColumn("Нужно", 1.4), TableColumn("Единица", 1.2)], rows,
    )  # fmt: skip


def _again(chapter: Chapter, made: ChangedSizes) -> TableBlock:
    """Values that the changes move, before and after, beside their limits."""
    terms, rows = chapter.terms, []
    for each, value, _ in _ranged(chapter):
        after = made.after[each.key] / quantity(each.key).si
        if abs(after - value) > _MOVED * abs(value):
            rows.append([titled_html(each.title), terms.sym(each.key), fixed(value, _RANGED),
                         fixed(after, _RANGED), limits(each.usual)])  # fmt: skip
    allowed = terms.num("strength_safety_allowed")
    for key in SAFETIES:
        if terms.has(key) and abs(made.after[key] - terms.value(key)) > _MOVED * terms.value(key):
            rows.append([titled_html(capital(terms.title(key))), terms.sym(key),
                         fixed(terms.value(key), _RANGED), fixed(made.after[key], _RANGED),
                         f"не менее{NBSP}{allowed}"])  # fmt: skip
    return table_block(
        [TableColumn("Величина", 4.2, text=True), TableColumn("Обозначение", 1.6),
         TableColumn("Было", 1.4), TableColumn("Стало", 1.4), TableColumn("Предел", 1.8)], rows,
    )  # fmt: skip


def _block(chapter: Chapter, name: str) -> ScalarTable:
    return next(block for block in chapter.model.blocks
                if isinstance(block, ScalarTable) and block.id == name)  # fmt: skip


def _pairs(block: ScalarTable) -> list[tuple[Scalar, Scalar]]:
    """Values with their verdicts."""
    return list(zip(block.scalars[::2], block.scalars[1::2], strict=True))


def _ranged(chapter: Chapter) -> list[tuple[UsualStress, float, int]]:
    """Results with a usual range, each with its value and the side of the range it is on."""
    section = chapter.input.strength
    assert section is not None
    values = [(each, chapter.terms.value(each.key)) for each in usual_stresses(section)]
    return [(each, value, each.excess(value)) for each, value in values]


def _outside(chapter: Chapter) -> list[tuple[str, str]]:
    """Values outside of their usual limits, each with what mends it."""
    return [(uncapital(each.title), each.mend if side > 0 else _SPARE)
            for each, _, side in _ranged(chapter) if side]  # fmt: skip


def _weak(chapter: Chapter) -> list[tuple[str, str]]:
    """Parts whose safety is less than allowed, each with what mends it."""
    terms = chapter.terms
    allowed = terms.value("strength_safety_allowed")
    return [(uncapital(value.note), _MENDS[value.key.removeprefix("value_")])
            for value, _ in _pairs(_block(chapter, "strength_allowed"))
            if terms.value(value.key) < allowed]  # fmt: skip


def _weakest_web(terms: Terms, throws: int) -> int:
    """Number of the throw whose web has the least safety; 0 where webs are not calculated."""
    if not terms.has("st_web_n"):
        return 0
    return min(range(1, throws + 1), key=lambda k: terms.value(f"st_web_n{k}"))


def _materials(chapter: Chapter) -> TableBlock:
    """Steels with the limits that the safeties are calculated with, and moduli of other parts."""
    terms, section = chapter.terms, chapter.input.strength
    assert section is not None
    parts = (("Шатун", "rod"), ("Шатунные болты", "bolt"), ("Щёки вала", "web"))
    rows: list[list[Markup | str]] = [
        [title, material_name(PART_MATERIALS[getattr(section, f"{part}_material")].label),
         *(terms.num(f"{part}_{key}") for key in _LIMITS)]
        for title, part in parts
        if part != "web" or terms.has("st_web_n")
    ]  # fmt: skip
    empty = ["—"] * (len(_LIMITS) - 1)
    rows += [
        [title, "—", *empty, terms.num(f"strength_{part}_modulus_mpa")]
        for title, part in (("Палец", "pin"), ("Втулка", "bush"), ("Кольцо", "ring"))
    ]
    columns = [TableColumn("Деталь", 2.4, text=True), TableColumn("Материал", 2, text=True)]
    columns += [TableColumn(symbol_head(terms.quantity(f"rod_{key}").tex, "МПа"), 1.4)
                for key in _LIMITS]  # fmt: skip
    return table_block(columns, rows)


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


def _ranges(chapter: Chapter) -> TableBlock:
    rows = [
        [titled_html(each.title), fixed(value, _RANGED), limits(each.usual), _SIDES[side]]
        for each, value, side in _ranged(chapter)
    ]  # fmt: skip
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
