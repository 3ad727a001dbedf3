"""Chapter on the strength of piston, ring, pin, rod, bolts and webs."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

from markupsafe import Markup

from kshm.nomenclature.quantity import quantity
from reports.document.chapters.chapter import Chapter
from reports.document.chapters.strength_changes import ChangedSizes, changed
from reports.document.page.blocks import (
    TableBlock,
    TableColumn,
    symbol_head,
    table_block,
)
from reports.document.page.charts import sketches_figure
from reports.document.page.numbering import Figure, TablePlan
from reports.document.text.symbols import titled_html
from reports.document.text.terms import Terms, material_name, plain_number
from reports.document.text.texts import of_digits
from reports.inputs.sections.strength import PART_MATERIALS
from reports.inputs.to_si.engine import to_engine
from reports.model.blocks import ScalarTable
from reports.shared.russian import NBSP, capital, fixed, joined, uncapital
from reports.tables.strength_members import SAFETIES, UsualStress, usual_stresses

_LIMITS = ("tensile", "yield", "bend", "pull", "turn", "modulus")  # columns of the materials
_RANGED = 2  # decimals of values beside their usual limits
_MOVED = 1e-3  # of a value: what changes less is not told again
_SIZE_NAMES = {"bush_fit": "strength_bush_fit_um"}


def concluded(chapter: Chapter) -> Markup:
    """Return the chapter's result in a line of the conclusion."""
    if chapter.input.strength is None:
        return Markup("")
    terms, block = chapter.terms, _block(chapter, "strength_allowed")
    allowed = terms.num("strength_safety_allowed")
    least = min((value for value, _ in block.pairs), key=lambda each: terms.value(each.key))
    side = "меньше" if _weak(chapter) else "не меньше"
    line = Markup("наименьший из запасов прочности деталей — {}, {}, он {} допускаемого {}").format(
        titled_html(uncapital(least.note)), fixed(terms.value(least.key), 2), side, allowed
    )
    titles = _titles(chapter)
    above = [uncapital(titles[each.key]) for each, _, side in _ranged(chapter) if side > 0]
    if above:
        line += Markup("; больше обычных пределов: {}").format(joined(above))
    return line


def _changed(chapter: Chapter) -> Markup:
    """Sizes with which all is within its limits, where something is not."""
    terms, section = chapter.terms, chapter.input.strength
    assert section is not None
    above = any(side > 0 for _, _, side in _ranged(chapter))
    if not (above or _weak(chapter)):
        return Markup("")
    sizes = changed(to_engine(chapter.input), usual_stresses(section), section.safety_allowed)
    if not sizes.changes:
        return Markup("")
    return chapter.page(
        "strength_changes",
        changes=TablePlan(partial(_changes, terms, sizes), "Изменение размеров", keep=True),
        again=TablePlan(partial(_again, chapter, sizes),
                        "Напряжения и запасы с изменёнными размерами", keep=True),
        left=[_title_of(chapter, key) for key in sizes.left],
        crown=_crown(chapter) if any(each.key == "crown" for each in sizes.changes) else "",
    )  # fmt: skip


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
    title = _titles(chapter).get(key)
    return uncapital(title) if title else chapter.terms.title(key)


def _titles(chapter: Chapter) -> dict[str, str]:
    """Titles of the values with a usual range, by key."""
    return {value.expr: value.note for value, _ in _block(chapter, "strength_ranges").pairs}


def _changes(terms: Terms, sizes: ChangedSizes) -> TableBlock:
    """Sizes before and after [mm]."""
    rows = []
    for each in sizes.changes:
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


def _again(chapter: Chapter, sizes: ChangedSizes) -> TableBlock:
    """Values that the changes move, before and after, beside their limits."""
    terms, rows = chapter.terms, []
    usual = {value.expr: value for value, _ in _block(chapter, "strength_ranges").pairs}
    for each, value, _ in _ranged(chapter):
        after = sizes.after[each.key] / quantity(each.key).si
        if abs(after - value) > _MOVED * abs(value):
            title, digits = usual[each.key].united, quantity(each.key).digits
            rows.append([titled_html(capital(title)), terms.sym(each.key), terms.num(each.key),
                         of_digits(after, digits), usual[each.key].span_text])  # fmt: skip
    allowed = terms.num("strength_safety_allowed")
    for key in SAFETIES:
        if terms.has(key) and abs(sizes.after[key] - terms.value(key)) > _MOVED * terms.value(key):
            rows.append([titled_html(capital(terms.title(key))), terms.sym(key),
                         fixed(terms.value(key), _RANGED), fixed(sizes.after[key], _RANGED),
                         f"не менее{NBSP}{allowed}"])  # fmt: skip
    return table_block(
        [TableColumn("Величина", 4.2, text=True), TableColumn("Обозначение", 1.6),
         TableColumn("Было", 1.4), TableColumn("Стало", 1.4), TableColumn("Предел", 1.8)], rows,
    )  # fmt: skip


def _block(chapter: Chapter, name: str) -> ScalarTable:
    return next(block for block in chapter.model.blocks
                if isinstance(block, ScalarTable) and block.id == name)  # fmt: skip


def _ranged(chapter: Chapter) -> list[tuple[UsualStress, float, int]]:
    """Results with a usual range, each with its value and the side of the range it is on."""
    section = chapter.input.strength
    assert section is not None
    values = [(each, chapter.terms.value(each.key)) for each in usual_stresses(section)]
    return [(each, value, each.side(value)) for each, value in values]


def _weak(chapter: Chapter) -> bool:
    """Whether a part's safety is less than allowed."""
    least = chapter.terms.value("strength_safety_allowed")
    pairs = _block(chapter, "strength_allowed").pairs
    return any(chapter.terms.value(value.key) < least for value, _ in pairs)


def _material_rows(chapter: Chapter) -> TableBlock:
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


def _size_rows(chapter: Chapter) -> TableBlock:
    """Sizes with where each is from."""
    terms, block = chapter.terms, _block(chapter, "strength_sizes")
    rows = [
        [titled_html(capital(scalar.quantity.title)), terms.sym(scalar.key), terms.num(scalar.key),
         titled_html(scalar.source.partition(" (")[0])]
        for scalar in block.scalars
    ]  # fmt: skip
    return table_block(
        [TableColumn("Размер, мм", 4.2, text=True), TableColumn("Обозначение", 1.6),
         TableColumn("Значение", 1.4), TableColumn("Основание", 2.4, text=True)], rows,
    )  # fmt: skip


def _materials(chapter: Chapter) -> TablePlan:
    return TablePlan(partial(_material_rows, chapter), "Материалы деталей")


def _sizes(chapter: Chapter) -> TablePlan:
    return TablePlan(partial(_size_rows, chapter), "Размеры частей")


def _sketches(caption: str, *names: str) -> Callable[[Chapter], Figure]:
    return lambda chapter: sketches_figure(chapter.terms, caption, *names)


VIEWS: dict[str, Callable[[Chapter], TablePlan | Figure]] = {
    "strength_materials": _materials, "strength_sizes": _sizes,
    "piston_sketch": _sketches("Поршень, размеры", "piston"),
    "rod_sketch": _sketches(
        f"Палец и шатун, размеры: а{NBSP}— палец; б{NBSP}— шатун", "pin", "rod"
    ),
    "web_sketch": _sketches("Щека, размеры", "web"),
}  # fmt: skip
INSERTS = {"strength_changes": _changed}
