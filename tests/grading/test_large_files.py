"""Files that are larger than what they claim to be are refused before they are taken apart."""

import pytest

from reports.grading.issuing.listing import listings
from reports.grading.issuing.register import load_register
from reports.grading.pages import moodle
from reports.shared.errors import InputError
from tests.grading.test_moodle import ENGLISH, worksheet


@pytest.mark.parametrize(
    ("read", "limit_mb", "what"), [(load_register, 50, "реестр"), (listings, 2, "список группы")]
)
def test_the_limit_is_the_one_that_is_told(tmp_path, read, limit_mb, what):
    path = tmp_path / "register.json"
    with path.open("wb") as stream:
        stream.truncate(limit_mb * 10**6 + 1)
    with pytest.raises(InputError, match=f"файл больше {limit_mb} МБ; это не {what}"):
        read(path)


def test_a_worksheet_as_large_as_the_limit(tmp_path, monkeypatch):
    path, text = tmp_path / "grades.csv", worksheet(ENGLISH)
    path.write_bytes(text.encode())
    monkeypatch.setattr(moodle, "MAX_BYTES", path.stat().st_size)
    assert moodle.read_worksheet(path) == text
    path.write_bytes(text.encode() + b"\n")
    with pytest.raises(InputError, match="это не ведомость Moodle"):
        moodle.read_worksheet(path)
