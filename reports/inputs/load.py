"""Read an input file, or the cells of an edited workbook, and check all of it at once.

`load_toml`, `load_text` and `load_mapping` return `Loaded`: the model, and
warnings about what is allowed but odd.  Errors come together in one
`InputError`, a `Problem` each.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path as FilePath
from typing import Any, cast

from pydantic import ValidationError

from reports.inputs import messages
from reports.inputs.checks import cross_checks
from reports.inputs.checks.bands import with_kind
from reports.inputs.checks.gas import check_gas
from reports.inputs.checks.pairs import check_pairs
from reports.inputs.checks.plausibility import check_plausibility
from reports.inputs.department_chapters import (
    Texts,
    checked_texts,
    named,
    own_model,
    sections_of,
    with_books,
)
from reports.inputs.diagram_file import with_points
from reports.inputs.fields import Path, from_cells, in_cells, key_text
from reports.inputs.findings import (
    Finding,
    ValidValues,
    accepted_keys,
    check_signs,
    explained,
    regime_data,
)
from reports.inputs.firing import FOLLOWING, expand
from reports.inputs.meta import StrictModel, hints
from reports.inputs.normalise import in_types, normalise, read_text, refuse_bomb, refused
from reports.inputs.ranges import read_ranges, split_ranges
from reports.inputs.reasons import PROTOTYPE_KEY
from reports.inputs.registry import GAS_MODELS, SECTIONS
from reports.inputs.sections.gas import SOURCES, CycleGasSection, PolytropicGasSection
from reports.inputs.sections.input_file import (
    DesignGeometrySection,
    InputFile,
    RegimeSection,
    RegimeValues,
)
from reports.inputs.sections.report import FILE_KEYS
from reports.inputs.to_si.masses import sizes_of
from reports.inputs.toml_errors import decimal_commas, toml_error
from reports.shared.errors import InputError, Problem, one_line

MAX_PROBLEMS = 200
Locate = Callable[[Path], str]
_Section = type[StrictModel]
_OFFSETS = re.compile(r"firing_offsets_deg(\[\d+\])?")


def inside(index: int, path: Path) -> Path:
    """Path in the file of a path within a regime."""
    if path and path[0] == "regime":
        return ("regimes", index, *path[1:])
    return ("regimes", index, *path)


def check_regime(values: ValidValues, regime: ValidValues) -> Iterator[Finding]:
    """Yield findings about a regime's gas in the engine of the file."""
    both = replace(regime, sections={**values.sections, **regime.sections})
    both.sections.pop("cycle", None)
    yield from check_gas(both)
    yield from (finding for finding in check_pairs(both) if finding.path[0] in regime.sections)


def joined(regime: StrictModel, gas: StrictModel) -> RegimeSection | None:
    """Regime of its two checked parts."""
    if not isinstance(regime, RegimeValues) or isinstance(gas, CycleGasSection):
        return None
    return RegimeSection.model_construct(**{**dict(regime), "gas": gas})


@dataclass(frozen=True, slots=True)
class Loaded:
    """Checked input with its warnings and accepted oddities."""

    model: InputFile
    warnings: tuple[Problem, ...]
    accepted: tuple[AcceptedOddity, ...] = ()
    beside: tuple[FilePath, ...] = ()  # further files that were read
    notes: tuple[str, ...] = ()  # what was made of them


@dataclass(frozen=True, slots=True)
class AcceptedOddity:
    """An oddity that the file itself explains."""

    problem: Problem
    reason: str

    def line(self) -> str:
        """Return the one-line message."""
        return one_line(f"{self.problem.where}: {self.problem.what}; причина: {self.reason}", 600)


def load_toml(path: FilePath | str) -> Loaded:
    """Read and check an input file.

    Raises:
        InputError: With everything that is wrong with the file.
    """
    file = FilePath(path)
    return load_text(read_text(file), source=file.name, folder=file.parent)


def load_text(text: str, *, source: str, folder: FilePath = FilePath()) -> Loaded:
    """Check the text of an input file; `source` names it in messages.

    `folder` is where a file with the points of the indicator diagram is looked for.
    """
    raw, section = split_ranges(parsed(text, source=source))
    if section is not None:
        # Ranges of variants serve "kshm issue"; one engine is calculated without them.
        problems = read_ranges(section, raw, source)[1]
        if problems:
            raise InputError(problems)
    raw, books = with_books(normalise(raw, source), folder, source)
    filled = with_points(raw, folder, source)
    try:
        loaded = load_mapping(filled.raw, source=source)
    except InputError as error:
        likely = [Problem(one_line(source, 120), *words) for words in decimal_commas(text)]
        raise InputError([*likely, *error.problems]) from None
    return replace(loaded, beside=(*filled.files, *books), notes=filled.notes)


def parsed(text: str, *, source: str) -> dict[str, Any]:
    """Nested mapping of a text.

    Raises:
        InputError: It is no TOML, or there is nothing in it.
    """
    raw = tables_of(text, source=source)
    if not raw:
        raise refused(source, "файл пуст", "заготовку даст команда «kshm new»")
    return raw


def tables_of(text: str, *, source: str) -> dict[str, Any]:
    """Nested mapping of a text that may hold comments only.

    Raises:
        InputError: It is no TOML.
    """
    refuse_bomb(source, text)
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise refused(source, "слишком глубокая вложенность", "уберите лишние скобки") from None
    except ValueError as error:  # TOMLDecodeError, or an integer of thousands of digits
        problem, hint = toml_error(error, text)
        raise refused(source, problem, hint) from None


def load_mapping(raw: Mapping[str, Any], *, source: str, locate: Locate | None = None) -> Loaded:
    """Check a nested mapping of the input file's shape.

    Args:
        raw: Sections, keys and values in user units.
        source: Name of the file in messages.
        locate: For the cells of a workbook: maps a path to "лист!ячейка".  Then
            whole numbers read as floats, labels of choices and numbers in
            text cells are accepted, and an empty cell is an error.

    Raises:
        InputError: With everything that is wrong.
    """
    reader = _SectionReader(source, locate)
    data = normalise(raw, source)
    regimes, books, department = data.pop("regimes", ()), data.pop("books", {}), data.pop("own", {})
    if locate is not None:
        data = reader.from_cells(data)
    reader.order_alone = _has_order_alone(data)
    texts = reader.books(books, named(data))
    own_sections = reader.own(department, texts)
    data, findings = expand(data)
    reader.take(findings)
    # What would have followed from what is wrong or missing is not missing as well.
    reader.empty |= {("crankshaft", key) for key in FOLLOWING[0 if reader.order_alone else 1 :]}
    models = reader.sections(data)
    further = reader.regimes(regimes)
    reader.take(cross_checks.check(reader.values))
    if reader.problems:
        raise InputError(_capped(source, reader.problems, reader.uncounted))
    parts = cast(dict[str, Any], models)
    model = with_kind(InputFile(**parts, regimes=further, books=texts, own=own_sections))
    design_sizes = None
    if model.cycle is not None:
        # Only a file with a cycle pays for the numeric part.
        from reports.inputs.to_si.cycle import cycle_and_findings

        run, findings = cycle_and_findings(model)
        reader.take(findings)
        if reader.problems:
            raise InputError(reader.problems)
        if run is not None and run.design is not None:
            design_sizes = run.design.bore, run.design.stroke
    accepted = accepted_keys(() if model.checks is None else model.checks.accepted)
    warned = {key for key, _ in reader.warnings} - accepted  # a line for each key
    odd = [*check_plausibility(model, sizes_of(model, design_sizes), accepted), *check_signs(model)]
    reader.take(finding for finding in odd if key_text(finding.path) not in warned)
    loaded = reader.loaded(model)
    if reader.problems:  # what else is odd may be the cause
        raise InputError([*reader.problems, *loaded.warnings])
    return loaded


def load_remote(raw: Mapping[str, Any]) -> Loaded:
    """Check a remote user's mapping: problems name keys alone, files are refused.

    Raises:
        InputError: With everything that is wrong, or that names files of this machine.
    """
    loaded = load_mapping(raw, source="")
    model = loaded.model
    named = [f"report.{key}" for key in FILE_KEYS if getattr(model.report, key)]
    named += [PROTOTYPE_KEY] if model.prototype is not None and model.prototype.file else []
    if named:
        words = "файлов с диска здесь не читают", "уберите ключ; команде kshm он доступен"
        raise InputError([Problem(key, *words) for key in named])
    return loaded


class _SectionReader:
    """Reader of one file that collects its problems section by section."""

    def __init__(self, source: str, locate: Locate | None, regime: int | None = None) -> None:
        self.source = one_line(source, 120)
        self.locate = locate
        self.regime = regime
        self.problems: list[Problem] = []
        self.warnings: list[tuple[str, Problem]] = []
        self.values = ValidValues()
        self.empty: set[Path] = set()
        self.uncounted = 0
        self.order_alone = False  # firing offsets follow from the order that the file has
        self.home: Path = ()  # before the paths of its sections

    def key(self, path: Path) -> str:
        if self.regime is not None:
            path = inside(self.regime, path)
        return one_line(key_text((*self.home, *path)), 100)

    def problem(self, path: Path, problem: str, hint: str = "") -> Problem:
        if self.order_alone and path[:2] == ("crankshaft", "firing_offsets_deg"):
            path = ("crankshaft", "firing_order")
        key = self.key(path)
        if self.regime is not None:
            path = inside(self.regime, path)
        if self.order_alone:
            problem, hint = (_OFFSETS.sub("firing_order", text) for text in (problem, hint))
        if self.locate is not None:
            problem, hint = in_cells(problem), in_cells(hint)
        home = (*self.home, *path)
        cell = self.locate(home) if self.locate is not None and path else ""
        address = f"{cell} ({key})" if cell else key
        return Problem(": ".join(part for part in (self.source, address) if part), problem, hint)

    def take(self, findings: Iterable[Finding]) -> None:
        for finding in findings:
            problem = self.problem(finding.path, finding.what, finding.hint)
            if finding.warning:
                self.warnings.append((self.key(finding.path), problem))
            else:
                self.problems.append(problem)

    def loaded(self, model: InputFile) -> Loaded:
        """Return the model with its warnings and accepted oddities."""
        entries = () if model.checks is None else model.checks.accepted
        odd, taken = explained(self.warnings, entries)
        return Loaded(model, tuple(odd), tuple(AcceptedOddity(*each) for each in taken))

    def from_cells(self, data: dict[str, Any]) -> dict[str, Any]:
        source = str(data["gas"].get("source")) if isinstance(data.get("gas"), dict) else ""
        models = {name: section.model for name, section in SECTIONS.items()}
        models["gas"] = GAS_MODELS.get(source, PolytropicGasSection)
        if self.regime is not None:
            models["regime"] = RegimeValues
        result, empty = from_cells(data, models)
        self.problems += [self.problem(path, "ячейка пуста", "впишите значение") for path in empty]
        self.empty = set(empty)
        self.values.broken |= {(str(path[0]), str(path[1])) for path in empty}
        self.values.unsure |= {str(path[0]) for path in empty}
        return result

    def sections(self, data: dict[str, Any]) -> dict[str, StrictModel]:
        unknown = [key for key in data if key not in SECTIONS]
        self.uncounted += max(0, len(unknown) - MAX_PROBLEMS)
        unknown = unknown[:MAX_PROBLEMS]
        guessed = set()
        for key in unknown:
            likely = messages.likely_word(key, SECTIONS)
            guessed.add(likely)
            hint = f"возможно, имелся в виду [{likely}]" if likely else "удалите его"
            self.problems.append(self.problem((key,), "неизвестный раздел или ключ", hint))
        models = {}
        for name, spec in SECTIONS.items():
            if name not in data and not spec.optional:
                if name not in guessed:
                    hint = f"добавьте раздел [{name}], ключи его покажет «kshm new»"
                    self.problems.append(self.problem((name,), "нет раздела", hint))
                continue
            if spec.absent and name not in data:
                continue
            model = self._model_of(name, data.get(name, {}))
            if name == "geometry" and model is not None and _sizes_are_wanted(data):
                model = DesignGeometrySection
            if model is not None:
                section = self._section(name, model, data.get(name, {}))
                if section is not None:
                    models[name] = section
        return models

    def books(self, raw: object, names: list[str]) -> Texts:
        """Names and texts of own books."""
        try:
            return checked_texts(raw, names)
        except InputError as error:
            self.problems += error.problems
            return ()

    def own(self, raw: object, books: Texts) -> StrictModel | None:
        """Return the sections of own books, [own.SECTION] in the file."""
        declared, reader = sections_of(books), _SectionReader(self.source, self.locate)
        reader.home = ("own",)
        tables, sections = raw if isinstance(raw, dict) else {}, {}
        for name in [name for name in tables if name not in declared and not self.problems][:1]:
            words = "раздела нет ни в одной своей книге", "назовите книгу в report.books"
            reader.problems.append(reader.problem((name,), *words))
        for name, spec in declared.items():
            assert spec.model is not None
            part = tables.get(name, {})
            if not isinstance(part, dict):
                problem = reader.problem((name,), f"нужен раздел, а задано: {messages.kind(part)}")
                reader.problems.append(problem)
                continue
            part = in_types(part, spec.model)
            if self.locate is not None:
                cells, empty = from_cells({name: part}, {name: spec.model})
                part, reader.empty = cells[name], reader.empty | set(empty)
                words = "ячейка пуста", "впишите значение"
                reader.problems += [reader.problem(at, *words) for at in empty]
            sections[name] = reader._section(name, spec.model, part)
        self.problems += reader.problems
        return own_model(books).model_construct(None, **sections) if sections else None

    def regimes(self, raw: object) -> tuple[RegimeSection, ...]:
        """Return the further regimes; each is read like a file with the same engine."""
        regimes = []
        for item in regime_data(raw):
            if isinstance(item, Finding):
                self.take([item])
                continue
            index, entry = item
            inner = _SectionReader(self.source, self.locate, index)
            regime = inner.one_regime(entry, self.values)
            self.problems += inner.problems
            self.warnings += inner.warnings
            if regime is not None:
                regimes.append(regime)
        return tuple(regimes)

    def one_regime(self, entry: dict[str, Any], engine: ValidValues) -> RegimeSection | None:
        """One regime of the engine whose values are given."""
        data = {"regime": {k: v for k, v in entry.items() if k != "gas"}, "gas": entry["gas"]}
        if self.locate is not None:
            data = self.from_cells(data)
        gas = self._model_of("gas", data["gas"])
        parts = [self._section("regime", RegimeValues, data["regime"])]
        if gas is not None:
            parts.append(self._section("gas", gas, data["gas"]))
            self.take(check_regime(engine, self.values))
        if self.problems or len(parts) < 2 or parts[0] is None or parts[1] is None:
            return None
        return joined(parts[0], parts[1])

    def _model_of(self, name: str, raw: object) -> _Section | None:
        if not isinstance(raw, dict):
            problem = f"нужен раздел [{name}], а задано: {messages.kind(raw)}"
            self.problems.append(self.problem((name,), problem))
            return None
        if name != "gas":
            return SECTIONS[name].model
        source = raw.get("source")
        if isinstance(source, str) and source in GAS_MODELS:
            return GAS_MODELS[source]
        problem = "обязательный ключ не задан"
        if "source" in raw:
            problem = f"недопустимое значение {messages.shown(source)}"
        allowed = (*GAS_MODELS, "file") if self.locate is None else SOURCES.values()
        hint = "допустимо: " + ", ".join(allowed)
        if ("gas", "source") not in self.empty:
            self.problems.append(self.problem(("gas", "source"), problem, hint))
        return None

    def _section(self, name: str, model: _Section, raw: dict[str, Any]) -> StrictModel | None:
        for key, value in raw.items():
            if isinstance(value, list | tuple):
                self.values.counts[name, key] = len(value)
        try:
            section = model.model_validate(raw)
        except ValidationError as error:
            self._report(name, model, error)
            self.values.sections[name] = _valid_part(model, raw, error)
            return None
        keys = hints(model).items()
        self.values.sections[name] = {key: getattr(section, spec.name) for key, spec in keys}
        return section

    def _report(self, name: str, model: _Section, error: ValidationError) -> None:
        errors = error.errors(include_url=False, include_context=False)
        for item in errors:
            if item["type"] == "extra_forbidden":
                self.values.unsure.add(name)
            elif item["type"] != "missing" or len(item["loc"]) > 1:
                self.values.broken.add((name, str(item["loc"][0])))
        # Words are costly: past the limit problems are only counted.
        self.uncounted += max(0, len(errors) - MAX_PROBLEMS)
        errors = errors[:MAX_PROBLEMS]
        guesses: set[tuple[Path, str | None]] = set()
        for item in errors:
            if item["type"] == "extra_forbidden":
                *parents, key = item["loc"]
                owner = _owner(model, tuple(parents))
                guesses.add((tuple(parents), messages.likely_key(str(key), owner)))
                words = messages.unknown_key(str(key), owner)
                self.problems.append(self.problem((name, *item["loc"]), *words))
        for item in errors:
            loc = item["loc"]
            # A misspelt key is one mistake, not also a missing key.
            if item["type"] == "extra_forbidden" or (loc[:-1], loc[-1]) in guesses:
                continue
            meta = messages.meta_at(model, loc)
            words = messages.explain(item, meta, in_book=self.locate is not None)
            problem = self.problem((name, *loc), *words)
            if (name, *loc) not in self.empty:
                self.problems.append(messages.measured(problem, item, meta))


def _has_order_alone(data: Mapping[str, Any]) -> bool:
    """Whether a file gives the firing order and not the offsets that follow from it."""
    shaft = data.get("crankshaft")
    return (
        isinstance(shaft, dict) and "firing_order" in shaft and ("firing_offsets_deg" not in shaft)
    )


def _sizes_are_wanted(data: dict[str, Any]) -> bool:
    """Whether bore and stroke follow from a given power."""
    cycle = data.get("cycle")
    return isinstance(cycle, dict) and "power_kw" in cycle


def _owner(model: _Section, parents: Path) -> _Section:
    for part in parents:
        if isinstance(part, str):
            model = hints(model)[part].inner or model
    return model


def _valid_part(model: _Section, raw: dict[str, Any], error: ValidationError) -> dict[str, Any]:
    """Return the fields that are valid by themselves, defaults filled in."""
    wrong = {item["loc"][0] for item in error.errors(include_url=False) if item["loc"]}
    validator = model.__pydantic_validator__
    blank = model.model_construct()
    values = {}
    for key, spec in hints(model).items():
        if key in wrong:
            continue
        part: Any = blank
        if key in raw:
            part = validator.validate_assignment(blank.model_copy(), spec.name, raw[key])
        values[key] = getattr(part, spec.name, None)
    return values


def _capped(source: str, problems: list[Problem], uncounted: int) -> list[Problem]:
    uncounted_problems = max(0, len(problems) - MAX_PROBLEMS) + uncounted
    if uncounted_problems == 0:
        return problems
    return [
        *problems[:MAX_PROBLEMS],
        Problem(one_line(source, 120), f"и ещё ошибок: {uncounted_problems}"),
    ]
