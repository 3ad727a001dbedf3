"""A table never needs more room than there is, and no cell less than it needs."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from markupsafe import Markup

from reports.document.page.blocks import TableColumn, symbol_head, table_block
from reports.document.page.fitting import fitted, least_width, type_pt
from reports.document.page.style import PX, USUAL, Margins, Style
from reports.draw.fonts import text_em
from reports.shared.russian import fixed

NARROW = Style(font_size_pt=16.0, margins=Margins(left=50.0, right=40.0))


def block(columns: int, value: float, rows: int = 30):
    heads = [TableColumn(symbol_head(r"\varphi", "°"))]
    heads += [TableColumn(symbol_head(rf"M_{{{i}}}", "Н·м")) for i in range(1, columns)]
    return table_block(heads, [[str(i), *[fixed(-value - i, 3)] * (columns - 1)]
                               for i in range(rows)])  # fmt: skip


def test_a_cell_of_two_lines_is_as_wide_as_the_longer_one():
    def needed(*lines):
        cells = [["Ход поршня", Markup("<br>").join(lines)]]
        return least_width(table_block([TableColumn("Величина"), TableColumn("А")], cells))

    assert needed("0,005039", "(+455,0\xa0%)") == needed("(+455,0\xa0%)")


@settings(max_examples=40)
@given(st.integers(2, 40), st.floats(0, 1e6), st.sampled_from([USUAL, NARROW]),
       st.sampled_from(["", "dense", "tiny"]))  # fmt: skip
def test_every_cell_has_the_room_it_needs(columns, value, style, size):
    whole = block(columns, value)
    parts, name = fitted(whole, size, style)
    em = style.table_em_px(name)
    for part in parts:
        shares = [float(width.rstrip("%")) / 100 for width in part.widths]
        assert sum(shares) <= 1.001
        for index, share in enumerate(shares):
            widest = max(text_em(row[index]) for row in part.rows) * em
            assert widest + 4 <= share * style.width_mm * PX
    shown = [number for part in parts for number in part.numbered[1:]]
    assert shown == list(range(2, columns + 1))
    assert all(part.numbered[0] == 1 and len(part.rows) == len(whole.rows) for part in parts)


def test_type_shrinks_before_the_columns_part():
    parts = {count: fitted(block(count, 10.0), "", USUAL) for count in (6, 11, 13, 20)}
    assert [(len(collected), size) for collected, size in parts.values()] == [
        (1, ""), (1, "dense"), (1, "tiny"), (2, "dense")
    ]  # fmt: skip


def test_a_table_that_fits_is_left_as_it_is():
    whole = block(6, 10.0)
    assert fitted(whole, "", USUAL) == ([whole], "")


@pytest.mark.parametrize("columns", [3, 13])
def test_least_width_grows_with_the_columns(columns):
    assert least_width(block(columns, 1e4)) > columns * 50


def test_type_of_a_cell_shrinks_then_wraps_then_gives_up():
    cell = (22.0, 4.6, 8.5)
    assert type_pt("Иванов И. И.", *cell) == 8.5
    assert 5 < type_pt("Преображенский А. А.", *cell) < 7
    # Two lines, parted at the hyphen.
    assert 5 <= type_pt("Преображенский-Вознесенский А. А.", *cell) < 6
    assert type_pt("Преображенский-Вознесенский-Константинопольский А. А.", *cell) == 0
    assert type_pt("слово " * 12, 48.0, 14.0, 8.5) == 8.5
    assert 0 < type_pt("слово " * 40, 48.0, 14.0, 8.5) < 8.5
