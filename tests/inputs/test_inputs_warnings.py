"""What is odd but allowed is a warning, and the input is still read."""

import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.shared import font_coverage
from reports.shared.errors import InputError
from tests.conftest import ROOT, sample

CASES = {
    "long rod": (
        ("geometry", "rod_length_mm", 400),
        "geometry.rod_length_mm: λ = 0,1175 необычно; обычно от 0,15 до 0,45",
    ),
    "short rod": (
        ("geometry", "rod_length_mm", 100),
        "geometry.rod_length_mm: λ = 0,47 необычно; обычно от 0,15 до 0,45",
    ),
    "force offsets": (
        ("crankshaft", "force_offsets_deg", [0, 480, 240]),
        "crankshaft.force_offsets_deg: фазы сил заданы отдельно и могут противоречить валу; "
        "ключ нужен только для воспроизведения таблицы П4.3",
    ),
    "low residual pressure": (
        ("gas", "residual_pressure_mpa", 0.05),
        "gas.residual_pressure_mpa: давление остаточных газов 0,05 МПа необычно; "
        "обычно от 0,1 до 0,2475 МПа",
    ),
    "low intake pressure": (
        ("gas", "intake_pressure_mpa", 0.025),
        "gas.intake_pressure_mpa: p_a = 0,025 МПа необычно; обычно от 0,05 до 0,49 МПа "
        "(по памяти); проверьте единицу и запятую",
    ),
    "pz below pure compression": (
        ("gas", "max_pressure_mpa", 8.5),
        "gas.max_pressure_mpa: p_z = 8,5 МПа ниже давления чистого сжатия в ВМТ; "
        "оно равно 8,604 МПа",
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_warns(case, raw):
    (section, key, value), message = CASES[case]
    raw[section][key] = value
    lines = [problem.line() for problem in load_mapping(raw, source="f.toml").warnings]
    assert f"f.toml: {message}" in lines


@pytest.mark.parametrize("ratio", [0.24, 0.6])
def test_an_odd_moment_of_inertia_of_the_rod_warns(raw, ratio):
    rod = 1.7 * (raw["geometry"]["rod_length_mm"] / 1000) ** 2
    raw["masses"] = {"piston_group_kg": 1.5, "rod_kg": 1.7, "rod_small_end_share": 0.3,
                     "rod_inertia_kg_m2": ratio * rod}  # fmt: skip
    lines = [problem.line() for problem in load_mapping(raw, source="f.toml").warnings]
    assert [line for line in lines if "m_ш·l²" in line] == [
        "f.toml: masses.rod_inertia_kg_m2: I_ш/(m_ш·l²) = 0,6 необычно; "
        "обычно от 0,05 до 0,45: проверьте кг·м²"
    ] * (ratio > 0.45)


def test_four_regimes_are_read_and_five_are_not(raw):
    one = {"speed_rpm": 2400.0, "gas": raw["gas"]}
    raw["regimes"] = [{"name": f"{n}", **one} for n in range(4)]
    assert len(load_mapping(raw, source="f.toml").model.regimes) == 4
    raw["regimes"].append({"name": "4", **one})
    with pytest.raises(InputError, match="режимов 5, а допустимо не больше 4"):
        load_mapping(raw, source="f.toml")


def test_rod_share_warns(raw):
    raw["masses"] = {"piston_group_kg": 1.5, "rod_kg": 1.7, "rod_small_end_share": 0.4}
    (warning,) = load_mapping(raw, source="f.toml").warnings
    assert warning.where == "f.toml: masses.rod_small_end_share"


def test_the_textbook_diesel_is_not_odd(raw):
    assert load_mapping(raw, source="f.toml").warnings == ()


def test_markup_and_slashes_in_a_name_are_text(raw):
    raw["engine"]["name"] = "=A1 ../<b>&amp;[red]«Д-240/5»"
    assert load_mapping(raw, source="f").model.engine.name == raw["engine"]["name"]


@pytest.mark.parametrize("lam", [47 / 148, 47 / 148 * 1.0009, 47 / 148 * 0.9991])
def test_three_that_agree(raw, lam):
    raw["geometry"] |= {"lambda": lam, "stroke_mm": 94}
    assert load_mapping(raw, source="f").warnings == ()


# What stands to the left of a number that is quoted as it is typed.
TYPED = re.compile(r"[a-z_]+ = |с точкой: |\[[\d., ]*")
CHANGES = (
    "geometry.bore_mm", "geometry.stroke_mm", "geometry.rod_length_mm", "regime.speed_rpm",
    "gas.max_pressure_mpa", "gas.residual_pressure_mpa", "gas.compression_exponent",
    "masses.piston_group_kg", "masses.rod_kg", "crankshaft.pin_diameter_mm",
    "crankshaft.pin_length_mm", "masses.rod_small_end_share",
)  # fmt: skip


@settings(max_examples=40)
@given(st.dictionaries(st.sampled_from(CHANGES), st.floats(0.03, 30), min_size=1, max_size=4))
def test_numbers_in_sentences_have_a_decimal_comma(changes):
    """Refusals and warnings of random files; only what is typed into the file keeps a point."""
    raw = to_mapping(sample("gots-diesel"))
    for path, times in changes.items():
        section, key = path.split(".")
        if isinstance(raw[section].get(key), int | float):
            raw[section][key] *= times
    try:
        lines = [problem.line() for problem in load_mapping(raw, source="f").warnings]
    except InputError as error:
        lines = [problem.line() for problem in error.problems]
    for line in lines:
        for matches in re.finditer(r"\d+\.\d+(?![\d.]|\w)", line):
            before = line[: matches.start()]
            assert re.search(f"(?:{TYPED.pattern})$", before) or "п." in before[-4:], line


def test_spans_in_the_words_of_the_checks_have_a_decimal_comma():
    """Random files rarely meet each check: the words themselves are read too."""
    for path in sorted((ROOT / "reports").rglob("*.py")):
        matches = re.findall(r"\b(?:от|до) \d+\.\d+", path.read_text("utf-8"))
        assert not matches, f"{path}: {matches}"


def test_a_sign_that_the_report_cannot_print_is_said_with_its_field(raw):
    """Once for each field, in files and in lists; usual foreign letters are no oddity."""
    raw["engine"]["name"] = "Мотор 🚗🔥🔥 ≤ µ ½ Škoda – «Ё»"
    raw["report"] = {"student": "Иванов 漢", "city": "Łódź", "group": "⚙\ufe0f-21"}
    loaded = load_mapping(raw, source="f.toml")
    assert [problem.line() for problem in loaded.warnings] == [
        "f.toml: report.student: в шрифте отчёта нет: 漢 (U+6F22); уберите или замените, иначе "
        "напечатается □",
        "f.toml: report.group: в шрифте отчёта нет: ⚙ (U+2699); уберите или замените, иначе "
        "напечатается □",
        "f.toml: engine.name: в шрифте отчёта нет: 🚗 (U+1F697), 🔥 (U+1F525); уберите или "
        "замените, иначе напечатается □",
    ]
    assert loaded.model.report.city == "Łódź"


@given(st.text(max_size=20))
def test_a_text_is_complained_of_when_a_box_would_be_printed(text):
    shown = font_coverage.printable(text.replace(font_coverage.REPLACEMENT, ""))
    assert (font_coverage.REPLACEMENT in shown) == bool(font_coverage.unprintable(text))


def test_what_nearly_all_texts_consist_of_is_in_the_font():
    usual = [chr(code) for code in range(32, 0x2200) if font_coverage.USUAL.fullmatch(chr(code))]
    assert len(usual) > 150
    assert {ord(sign) for sign in usual} <= font_coverage.coverage()
