"""A file holds one subject: none is so long that it must hold more."""

from pathlib import Path

ROOT = Path(__file__).parents[2]
MOST = 500


def test_no_file_is_too_long() -> None:
    paths = [path for room in ("kshm", "reports", "tools") for path in (ROOT / room).rglob("*.py")]
    lines = {path.name: len(path.read_text(encoding="utf-8").splitlines()) for path in paths}
    assert len(paths) > 200
    assert {name: count for name, count in lines.items() if count > MOST} == {}
