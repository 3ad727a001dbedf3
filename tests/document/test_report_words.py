"""Sentences of notes with every chapter that have to agree with what stands beside them."""

from __future__ import annotations

import re
from functools import cache

import pytest

from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from tests.conftest import sample
from tests.document.bare_pages import bare_page, plain
from tests.document.test_report_parts import page_of

pytestmark = [pytest.mark.usefixtures("nothing_is_drawn"), pytest.mark.xdist_group("sentences")]


@cache
def words_of(name: str) -> str:
    return plain(page_of(name))


def test_a_film_above_the_critical_one_does_not_touch():
    """«возможно касание» stood beside «за весь цикл плёнка не рвётся», at a reserve of 1.15."""
    thick, thin = words_of("yamz-236"), words_of("gots-diesel")
    assert "за весь цикл плёнка не рвётся" in thick and "возможно касание" not in thick
    assert "меньше допускаемого (4,50): неровности шейки и вкладыша не касаются" in thick
    assert thin.count("возможно касание") == 2 and "не касаются" not in thin


def test_equal_angles_of_the_oil_hole_are_told_once():
    """«315° при наименьшем и 315° при наибольшем зазоре … по последним углам»."""
    assert not re.search(r"(\d+°) при наименьшем и \1 при наибольшем", words_of("two-stroke"))
    assert re.search(
        r"по плёнке — \d+° при обоих зазорах.*?по последнему углу", words_of("two-stroke")
    )
    assert "при наибольшем зазоре. Отверстие следует" in words_of("gots-diesel")


@pytest.mark.parametrize("name", ["two-stroke", "gots-diesel", "one", "V12"])
def test_one_table_is_not_tables(name: str):
    """«для всех углов даны в таблицах Б.4» of a shaft whose journals are loaded alike."""
    told = re.findall(r"(?:таблицах|рисунках) ((?:[АБ]\.)?\d+)(.{3})", words_of(name))
    assert told
    assert [number for number, after in told if not re.match(r" и|–|, (?:[АБ]|\d)", after)] == []


def test_the_assumed_masses_are_told_beside_the_table_that_has_them():
    text = words_of("gots-diesel")
    told, sizes = (
        text.index("Массы шатуна и поршневой группы не заданы"),
        "Размеры маховика Маховик",
    )
    assert text.index("Момент инерции и неравномерность хода") < told < text.index(sizes)


def test_the_kind_of_the_parts_is_that_of_the_engine():
    """A petrol two-stroke was held against diesels too, its ignition was «впрыск (зажигание)»."""
    raw = to_mapping(sample("two-stroke")) | {"strength": {"kind": "petrol"}}
    stated = plain(bare_page(load_mapping(raw, source="").model))
    assert "с обычными для двигателей этого вида" in stated and "(зажигания)" not in stated
    open_kind = plain(bare_page(load_mapping(raw | {"strength": {}}, source="").model))
    assert "зажиганием и дизелей" in open_kind


def test_the_pressure_of_a_boosted_petrol_engine_is_held_to_no_limit_of_others():
    """11,09 MPa was «выше 3,5…7,5», and every result of the cycle within its limits."""
    text = words_of("cycle-turbo-petrol")
    assert "Обычно" in text or "обычно" in text
    assert "Наибольшее давление цикла p_z" not in text and "3,5…7,5" not in text
