import copy
import tomllib

import pytest

from reports.inputs.load import load_mapping
from reports.shared.errors import InputError
from reports.shared.resources import samples_dir

_DIESEL = tomllib.loads((samples_dir() / "gots-diesel.toml").read_text(encoding="utf-8"))


@pytest.fixture
def raw():
    return copy.deepcopy(_DIESEL)


@pytest.fixture
def refused():
    """The message lines with which a mapping is refused."""

    def lines(data):
        with pytest.raises(InputError) as caught:
            load_mapping(data, source="f.toml")
        assert caught.value.exit_code == 2
        assert all("\n" not in line for line in caught.value.lines())
        return caught.value.lines()

    return lines
