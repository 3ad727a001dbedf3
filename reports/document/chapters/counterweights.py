"""Chapter on the counterweights proposed for the webs."""

from __future__ import annotations

from functools import partial

from markupsafe import Markup

from reports.document.chapters.chapter import Chapter
from reports.document.page.blocks import TableBlock, TableColumn, symbol_head, table_block
from reports.document.page.charts import counterweight_figure
from reports.document.page.numbering import Figure, TablePlan
from reports.document.text.terms import Terms
from reports.model.shape import Shape
from reports.shared.russian import fixed

_SECTOR = ("cw_unit", "cw_free_mm", "cw_inner_mm", "cw_outer_mm", "cw_width_mm",
           "counterweight_density_kg_m3", "cw_angle_deg", "cw_mass", "cw_centre_mm")  # fmt: skip
_STATES = ("bare", "now", "new")
_PRINTED = 4  # every so many rows of the scan
_VISIBLE = 0.005  # share of the loads that their percents show


def counterweights(chapter: Chapter) -> Markup:
    """Share by the scan, sector, loads of the main journals before and after."""
    section = chapter.input.counterweight
    if section is None:
        return Markup("")
    terms = chapter.terms
    best, taken = terms.value("cw_best"), terms.value("cw_taken")
    residue = [key for key in ("cw_F_kN", "cw_M_Nm") if terms.has(f"counterweight_scan.{key}")
               and terms.column(f"counterweight_scan.{key}").max() > 1e-3]  # fmt: skip
    figure = "counterweight_residue"
    return chapter.page(
        "counterweights",
        section=section,
        tables={
            "scan": TablePlan(partial(_scan, terms, residue), "Перебор доли противовесов",
                              keep=True),
            "sector": chapter.scalars("Противовес щеки", _SECTOR, size="dense", keep=True),
            "loads": TablePlan(partial(_loads, terms), "Нагрузки коренных шеек, кН", keep=True),
        },
        sketch=Figure(partial(counterweight_figure, terms), "Щека с противовесом, размеры в мм"),
        residue=residue,
        left=figure if _shown(chapter, figure, residue) else "",
        by_residue=section.goal == "residue" and bool(residue),
        limited=section.share is None and taken < best - 1e-9,
        edge=best in (0.0, 2.0),
        holds=terms.value("cw_moment") <= terms.value("cw_half"),
        better=1 - terms.value("cw_new_sum_kN") / terms.value("cw_now_sum_kN"),
        middle=(Shape.of(chapter.input).throws + 2) // 2,
        percent=_percent,
        keep=_keeps(chapter),
        worse=[(_more_loaded(chapter, "now"), "с исходными"),
               (_more_loaded(chapter, "bare"), "без противовесов")],
    )  # fmt: skip


def concluded(chapter: Chapter) -> Markup:
    """Return the chapter's result in a line of the conclusion."""
    if chapter.input.counterweight is None:
        return Markup("")
    terms = chapter.terms
    line = "противовесы щёк берут долю {} вращающихся масс колена: угол {}, масса {}; сумма средних"
    line += " нагрузок коренных шеек {}, без противовесов — {}"
    keys = ["cw_angle_deg", "cw_mass", "cw_new_sum_kN", "cw_bare_sum_kN"]
    if _keeps(chapter):
        line += ", с исходными — {}: исходные следует оставить"
        keys.append("cw_now_sum_kN")
    return Markup(line).format(terms.num("cw_taken"), *(terms.val(key) for key in keys))


def _keeps(chapter: Chapter) -> bool:
    """Whether the given counterweights relieve the journals better, where that is the goal."""
    section, value = chapter.input.counterweight, chapter.terms.value
    assert section is not None
    more = value("cw_new_sum_kN") / value("cw_now_sum_kN") - 1
    return section.goal == "loads" and more > _VISIBLE


def _more_loaded(chapter: Chapter, than: str) -> list[int]:
    """Journals whose greatest load the proposed counterweights make larger."""
    value = chapter.terms.value
    return [j for j in Shape.of(chapter.input).journal_numbers
            if value(f"cw_new_max{j}_kN") > value(f"cw_{than}_max{j}_kN") * 1.0005]  # fmt: skip


def _shown(chapter: Chapter, chart: str, residue: list[str]) -> bool:
    """Whether the chart of the residue shows what does not vanish."""
    spec = chapter.model.charts_by_id.get(chart)
    return spec is not None and spec.series[0].y.rpartition(".")[2] in residue


def _percent(share: float) -> str:
    return fixed(100 * abs(share), 0)


def _scan(terms: Terms, residue: list[str]) -> TableBlock:
    """Every fourth row of the scan."""
    keys = ["cw_k", "cw_sum_kN", *residue]
    names = [f"counterweight_scan.{key}" for key in keys]
    columns = [TableColumn(symbol_head(terms.tex(name), terms.unit(name)), 1.6) for name in names]
    rows = range(0, len(terms.column(names[0])), _PRINTED)
    shares = terms.column(names[0])
    return table_block(columns, [[terms.num(name, shares[n]) for name in names] for n in rows])


def _loads(terms: Terms) -> TableBlock:
    """Mean and greatest loads of every journal without, with given and with proposed ones."""
    keys = [f"cw_{state}_{part}1_kN" for part in ("mean", "max") for state in _STATES]
    columns = [TableColumn("Шейка", 1.2)]
    columns += [TableColumn(symbol_head(terms.tex(key), ""), 1.6) for key in keys]
    rows = [
        [str(j), *(terms.num(key.replace("1_kN", f"{j}_kN")) for key in keys)]
        for j in Shape.of(terms.model.input).journal_numbers
    ]
    rows.append(["Сумма", *(terms.num(f"cw_{state}_sum_kN") for state in _STATES), *["—"] * 3])
    return table_block(columns, rows)
