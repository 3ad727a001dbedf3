import pytest

from reports.document.page.numbering import Draft, Numbering
from reports.shared.errors import NumberingError


@pytest.fixture
def numbering():
    result = Numbering()
    result.declare("figure", "path")
    result.declare("figure", "speed")
    result.declare("table", "P4_1", number="П4.1")
    result.declare("formula", "j")
    return result


def use(numbering, *keys):
    for kind, key in keys:
        numbering.refer(kind, key)
        numbering.place(kind, key)


ALL = (("figure", "path"), ("figure", "speed"), ("table", "P4_1"), ("formula", "j"))


def test_numbers_follow_declaration_and_references_link(numbering):
    assert numbering.fig("speed") == '<a class="ref" href="#ris-speed">2</a>'
    assert numbering.tab("P4_1") == '<a class="ref" href="#tab-P4_1">П4.1</a>'
    assert numbering.eq("j") == '(<a class="ref" href="#eq-j">1</a>)'
    assert numbering.place("figure", "speed").number == "2"


def test_all_used_is_fine(numbering):
    use(numbering, *ALL)
    numbering.check()
    assert numbering.count("figure") == 2


def test_missing_thing_is_named(numbering):
    use(numbering, *ALL[1:])
    numbering.fig("path")
    with pytest.raises(NumberingError, match=r"рисунок 1 «path»: есть ссылка, но в отчёте нет"):
        numbering.check()


def test_order_is_checked(numbering):
    use(numbering, ALL[1], ALL[0], *ALL[2:])
    with pytest.raises(NumberingError, match="порядок"):
        numbering.check()


def test_reference_must_come_before(numbering):
    numbering.place("figure", "path")
    use(numbering, *ALL[1:])
    assert numbering.problems() == ["рисунок 1 «path»: нет ссылки до появления"]


def test_unknown_double_and_stolen_are_refused(numbering):
    with pytest.raises(NumberingError, match="необъявленное"):
        numbering.fig("nothing")
    with pytest.raises(NumberingError, match="дважды"):
        numbering.declare("figure", "path")
    with pytest.raises(NumberingError, match="номер уже у «P4_1»"):
        numbering.declare("table", "other", number="П4.1")
    numbering.place("table", "P4_1")
    with pytest.raises(NumberingError, match="помещено дважды"):
        numbering.place("table", "P4_1")


def test_sections_count_by_level():
    numbering = Numbering()
    numbers = [numbering.section(level, "x").number for level in (1, 2, 2, 3, 2, 1, 2)]
    assert numbers == ["1", "1.1", "1.2", "1.2.1", "1.3", "2", "2.1"]
    assert numbering.section(1, "Заключение", numbered=False).number == ""
    assert [item.level for item in numbering.contents][-1] == 1
    with pytest.raises(NumberingError, match="без раздела"):
        Numbering().section(2, "x")


def test_the_draft_gives_numbers_in_order_of_standing():
    draft = Draft()
    assert draft.refer("figure", "late") == "?"
    for key in ("early", "late"):
        draft.place("figure", key)
    draft.place("table", "a", number="П1")
    with pytest.raises(NumberingError, match="дважды"):
        draft.place("figure", "late")
    numbering = draft.numbering()
    assert numbering.label("figure", "late").number == "2"
    assert numbering.place("table", "a", number="П1").number == "П1"
    assert numbering.count("figure") == 0 and numbering.count("table") == 1


def test_anchors_are_ascii_and_distinct():
    numbering = Numbering()
    anchors = {numbering.declare("figure", key).anchor for key in ("ф", ".444.", "a b", "ab")}
    assert len(anchors) == 4 and all(anchor.isascii() and " " not in anchor for anchor in anchors)


def test_sources():
    numbering = Numbering()
    for key in ("gots", "gost"):
        numbering.declare("source", key)
    assert numbering.src("gost", "gots").startswith("[<a") and numbering.src("gost").endswith("]")
