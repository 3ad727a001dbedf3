"""Chapter on the regimes: forces of figures 23-25, loads side by side, what governs."""

from __future__ import annotations

from functools import partial

from markupsafe import Markup

from reports.document.chapters.chapter import Chapter, pin_stems, worst_pin
from reports.document.page.blocks import TableBlock, TableColumn, list_block, table_block, unit_cell
from reports.document.page.numbering import TablePlan
from reports.document.text.symbols import inline_html
from reports.document.text.terms import input_text
from reports.document.text.texts import of_digits
from reports.formula.tex import input_symbol_tex
from reports.shared.font_coverage import cleaned
from reports.shared.russian import BREAK, capital
from reports.tables.regimes import regime_titles

_PARTS = (
    ("Ps_max", "поршень, палец и сжатие шатуна"),
    ("Ps_min", "растяжение шатуна"),
)


def regimes(chapter: Chapter) -> Markup:
    """Comparison of the regimes; nothing for one regime."""
    if not chapter.input.regimes:
        return Markup("")
    titles = regime_titles(chapter.input)
    return chapter.page(
        "regimes",
        titles=titles,
        figures=[f"regime_{n}" for n in range(1, len(titles) + 1)],
        data=TablePlan(partial(_inputs, chapter), "Данные дополнительных режимов", size="dense"),
        loads=TablePlan(partial(_loads, chapter), "Силы и нагрузки по режимам", size="dense"),
        governing=_governing(chapter),
    )


def concluded(chapter: Chapter) -> Markup:
    """Return the chapter's result in a line of the conclusion: which regime governs what."""
    if not chapter.input.regimes:
        return Markup("")
    by_regime: dict[str, list[str]] = {}
    for part, name in _governing(chapter):
        by_regime.setdefault(name, []).append(part)
    # Between a quotation mark and a bracket no line ends by itself, not even at a space.
    governing = [
        Markup("«{}» {}({})").format(cleaned(name), BREAK, "; ".join(parts))
        for name, parts in by_regime.items()
    ]
    count = len(chapter.input.regimes) + 1
    words = "режим" if len(governing) == 1 else "режимы"
    verb = "определяет" if len(governing) == 1 else "определяют"
    line = "из {} режимов работы расчёт {} {}: {}"
    return Markup(line).format(count, verb, words, Markup(", ").join(governing))


def _inputs(chapter: Chapter) -> TableBlock:
    rows = [
        [
            f"{field.section}. {field.title}",
            inline_html(input_symbol_tex(field.symbol)) if field.symbol else "—",
            input_text(field),
            unit_cell(field.unit),
        ]
        for field in chapter.model.inputs
        if field.path[0] == "regimes" and not field.listed
    ]
    return list_block(rows)


def _loads(chapter: Chapter) -> TableBlock:
    scalars, titles = chapter.terms.values.scalars, regime_titles(chapter.input)
    rows = []
    for row in chapter.grid("regime_loads").rows:
        q = row.quantity
        values = [scalars[cell.key] for cell in row.cells if cell is not None]
        unit = f", {q.unit_label}" if q.unit_label else ""
        texts = [of_digits(float(value), q.digits) for value in values[:-1]]
        rows.append([capital(q.title) + unit, *texts, str(values[-1])])
    columns = [
        TableColumn("Величина", 3.0, text=True),
        *(TableColumn(title, 1.6) for title in titles),
        TableColumn("Определяющий режим", 1.6, text=True),
    ]
    return table_block(columns, rows)


def _governing(chapter: Chapter) -> list[tuple[str, str]]:
    """Parts of the mechanism with the regime that governs each."""
    main, pin = chapter.worst("worst_main_load"), chapter.worst("worst_pin_torque")
    stems, worst = pin_stems(chapter.shape), worst_pin(chapter.terms)
    number = f" {worst}" if len(stems) > 1 else ""
    parts = (
        *_PARTS,
        (f"R{stems[worst - 1]}_max", f"шатунная шейка{number} и её подшипник"),
        (f"Rmain{main}_max", f"коренная шейка {main}"),
        (f"dM_pin{pin}", f"кручение шатунной шейки {pin}"),
    )
    scalars = chapter.terms.values.scalars
    return [(part, str(scalars[f"governs_{key}"])) for key, part in parts]
