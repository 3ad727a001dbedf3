"""The text of a made engine: what a beginner must know first, the rest below a line."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from datetime import UTC, datetime
from typing import Any

import tomlkit

from reports.inputs.meta import Strictly, hints
from reports.inputs.own_engine import Made, Notes
from reports.inputs.registry import SECTIONS, records

FIRST = ("engine", "geometry", "regime", "gas")
LINE = "──── дальше — необязательное: подставлены обычные значения ────"
_HEAD = (
    "Число пишется с точкой; окончание ключа называет единицу:",
    "_mm — мм, _kg — кг, _mpa — МПа, _deg — градусы, _rpm — мин⁻¹, _kw — кВт.",
)


def file_text(made: Made) -> str:
    """The engine as a commented input file."""
    lines = [f"# {line}" for line in (*made.head, *_HEAD)]
    rest = [name for name in SECTIONS if name not in FIRST and name in made.data]
    for name in FIRST:
        lines += ["", *_section(name, made.data[name], made.notes)]
    lines += ["", f"# {LINE}"]
    for name in rest:
        lines += ["", *_section(name, made.data[name], made.notes)]
    if "report" not in made.data:
        lines += ["", "[report] # фамилия, группа и вуз для титульного листа"]
        lines += ['student = ""', 'group = ""', 'institution = ""']
        lines += [f"year = {datetime.now(tz=UTC).year}"]
    for regime in made.data.get("regimes", ()):
        gas = {"gas": regime["gas"]}
        plain = {key: value for key, value in regime.items() if key != "gas"}
        lines += ["", *_keys("regimes", plain, {}, {}, "[[regimes]]")]
        lines += ["", *_keys("gas", gas["gas"], {}, {}, "[regimes.gas]")]
    return "\n".join(lines) + "\n"


def _section(name: str, values: Mapping[str, Any], notes: Notes) -> Iterator[str]:
    section = SECTIONS[name]
    model = section.sources.get(str(values.get("source")), section.model)
    lists = {key: values[key] for key, _ in records(model) if key in values}
    plain = {key: value for key, value in values.items() if key not in lists}
    yield from _keys(name, plain, notes, _titles(model), f"[{name}] # {section.title.lower()}")
    for key, inner in records(model):
        for number, entry in enumerate(lists.get(key, ())):
            # The entries of a made shaft are alike: the first one is explained.
            titles = _titles(inner) if number == 0 else {}
            own = notes if number == 0 else {}
            head = f"[[{name}.{key}]] # {number + 1}"
            yield ""
            yield from _keys(f"{name}.{key}", entry, own, titles, head)


def _titles(model: type[Strictly]) -> dict[str, str]:
    titles = {}
    for key, about in hints(model).items():
        for meta in about.metas[:1]:
            title = meta.title.replace("{n}", "N").removeprefix("Щека N: ")
            titles[key] = title.removeprefix("Колено N: ").replace(" N:", ":")
            options = meta.choices or {}
            if any(word != label for word, label in options.items()) and len(options) < 5:
                words = ", ".join(f"{word} — {label}" for word, label in options.items())
                titles[key] += f": {words}"
    return titles


def _keys(
    path: str, values: Mapping[str, Any], notes: Notes, titles: Mapping[str, str], head: str
) -> Iterator[str]:
    yield head
    for key, value in values.items():
        words = [titles.get(key, ""), notes.get(f"{path}.{key}", "")]
        comment = ": ".join(word for word in words if word)
        text = tomlkit.item(_plain(value)).as_string()
        yield f"{key} = {text}" + (f" # {comment}" if comment else "")


def _plain(value: Any) -> Any:  # noqa: ANN401
    """Whole numbers of files without a needless fraction, tuples as lists."""
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if isinstance(value, float) and value.is_integer() and abs(value) < 1e9:
        return int(value)
    return value
