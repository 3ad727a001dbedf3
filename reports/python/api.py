"""The report engine from Python: files, mappings and samples in, engines, books and figures out."""

from __future__ import annotations

import fnmatch
import warnings
from collections.abc import Mapping, Sequence
from functools import cached_property
from io import IOBase
from pathlib import Path
from typing import TYPE_CHECKING, Any

from kshm.engine.engine import Engine
from kshm.engine.source import Further, MakeEngine, Source
from reports.exports.build import Built, Kind, kinds_of, load_input
from reports.inputs.fields import Field, iter_fields, to_mapping
from reports.inputs.load import Loaded, load_mapping, load_text
from reports.inputs.normalise import text_of
from reports.inputs.template import list_samples, set_file
from reports.inputs.to_si.engine import engine_and_cycle
from reports.shared.errors import InputError, Problem, one_line
from reports.shared.resources import samples_dir
from reports.studies.plan import dotted

if TYPE_CHECKING:
    from kshm.cycle.cycle import CycleRun
    from reports.inputs.fields import Path as KeyPath
    from reports.inputs.sections.input_file import InputFile

Input = Path | str | bytes | IOBase | Mapping[str, Any] | Engine
_UNNAMED = "двигатель"  # what files of an input without a name are called
_NUMBERED = "*"  # every member of a list


class FileSource(Source):
    """The checked input that an engine was read from."""

    def __init__(self, model: InputFile, name: str, cycle: CycleRun | None, engine: Engine) -> None:
        self.model, self.name, self.cycle, self._made = model, name, cycle, engine

    def has_made(self, engine: Engine) -> bool:
        """Tell whether an engine is as it was read."""
        return engine == self._made

    def further(self) -> Further:
        """Return the numbers of own books."""
        if not self.model.books:
            return Further()
        from reports.exports.department_chapters import own_numbers

        numbers = own_numbers(self.model)
        scalars = {
            key: (quantity, float(value))
            for key, (quantity, value) in numbers.scalars.items()
            if not isinstance(value, str)
        }
        return Further(scalars, numbers.tables)

    @cached_property
    def _fields(self) -> dict[str, Field]:
        return {dotted(field.path): field for field in iter_fields(self.model)}

    def find(self, name: str) -> str:
        """Return the key that a name means: itself, a pattern, or the last word of one key."""
        if not isinstance(name, str):
            return ""
        if name in self._fields or self._meant(name):
            return name
        last = [
            key for key in self._fields if key.rpartition(".")[2] == name and key.count(".") == 1
        ]
        return last[0] if len(last) == 1 else ""

    def _meant(self, key: str) -> list[Field]:
        if _NUMBERED not in key:
            return [self._fields[key]] if key in self._fields else []
        return [field for name, field in self._fields.items() if fnmatch.fnmatchcase(name, key)]

    def unit(self, key: str) -> str:
        """Return the label of a key's unit."""
        return self._meant(key)[0].unit

    def title(self, key: str) -> str:
        """Return what a key means, with its unit."""
        field = self._meant(key)[0]
        return f"{field.title}, {field.unit}" if field.unit else field.title

    def values(self, key: str) -> Mapping[str, float]:
        """Return the values of a key, or of every member of a key with a star, by their keys."""
        meant = self._meant(key)
        for field in meant:
            if isinstance(field.value, bool | str):
                problem = f"значение ключа {dotted(field.path)} — не число"
                raise InputError(Problem(self.name, problem, "выберите числовой ключ"))
        return {dotted(field.path): float(field.value) for field in meant}

    def names(self) -> Sequence[str]:
        """Return the keys of the file."""
        return list(self._fields)

    def rows(self, keys: Sequence[str]) -> MakeEngine:
        """Return what makes an engine of other values of keys, with a source of its own."""
        from reports.inputs.revisions import Revisions

        paths: list[KeyPath] = []
        columns: list[int] = []
        for column, key in enumerate(keys):
            for field in self._meant(key):
                paths.append(field.path)
                columns.append(column)
        revisions = Revisions(to_mapping(self.model), self.name, paths)

        def engine_of(row: Sequence[Any]) -> Engine:
            engine, cycle = revisions.engine([row[column] for column in columns])
            return _with_source(engine, revisions.revised, self.name, cycle)

        return engine_of


def _with_source(engine: Engine, model: InputFile, name: str, cycle: CycleRun | None) -> Engine:
    """Tell a new engine what it was read from."""
    source = FileSource(model, name, cycle, engine)
    # Nobody has the engine yet; a copy would check all its numbers again.
    object.__setattr__(engine, "source", source)
    return engine


def load(source: Input, *, warn: bool = True) -> Engine:
    """Read the engine of an input file, of a workbook, of a mapping, or of a sample.

    Args:
        source: a path of a ``.toml`` file or of a workbook that a person edited; the text of a
            file as bytes, or a stream of it; a mapping of sections; the name of a sample, one of
            ``samples()``.
        warn: what is allowed but odd is a ``UserWarning``, one line each, in Russian.

    Returns:
        The engine in SI units.  It knows its input: ``engine.with_`` and ``kshm.sweep`` take the
        keys of the file, ``kshm.solve`` gives every number of ``kshm solve --json``.

    Raises:
        InputError: with everything that is wrong with the input, in ``problems``.

    >>> engine = load("samples/gots-diesel.toml")
    >>> engine.cylinders, round(engine.geometry.bore, 3)  # SI units
    (3, 0.088)
    >>> load("gots-diesel") == engine  # a sample by its name
    True
    """
    _, loaded = loaded_of(source)
    if warn:
        for odd in loaded.warnings:
            warnings.warn(odd.line(), stacklevel=3)
    engine, cycle = engine_and_cycle(loaded.model)
    return _with_source(engine, loaded.model, _path_of(source).name, cycle)


def loaded_of(source: Input) -> tuple[Path, Loaded]:
    """Return the checked input of whatever `load` takes, with the path that its files follow.

    Raises:
        InputError: with everything that is wrong with it.
    """
    path = _path_of(source)
    if isinstance(source, Engine):
        file = source.source
        if not isinstance(file, FileSource) or not file.has_made(source):
            problem = "двигатель собран из чисел или изменён после чтения"
            raise InputError(Problem("", problem, "дайте файл или меняйте его через engine.with_"))
        return path, Loaded(file.model, ())
    if isinstance(source, Mapping):
        return path, load_mapping(source, source="")
    if isinstance(source, IOBase):
        source = source.read()
        source = source.encode() if isinstance(source, str) else source
    if isinstance(source, bytes | bytearray | memoryview):
        return path, load_text(text_of(bytes(source), ""), source="")
    return path, load_input(path)


def _path_of(source: Input) -> Path:
    if isinstance(source, Engine) and isinstance(source.source, FileSource):
        return Path(source.source.name or _UNNAMED)
    if not isinstance(source, str | Path):
        if not isinstance(source, Engine | Mapping | IOBase | bytes | bytearray | memoryview):
            problem = f"нужен путь, словарь, байты или поток, а задано: {type(source).__name__}"
            raise InputError(Problem("", one_line(problem), "пример: reports.load('engine.toml')"))
        return Path(_UNNAMED)
    path = Path(source)
    is_name = isinstance(source, str) and not path.suffix and not path.exists()
    return samples_dir() / f"{source}.toml" if is_name and source in list_samples() else path


def samples() -> tuple[str, ...]:
    """Return the names of the sample engines, which `load` takes; also of an installed wheel.

    >>> "gots-diesel" in samples()
    True
    """
    return list_samples()


def dump(engine: Engine | Mapping[str, Any], path: Path | str | None = None) -> str:
    """Return the input file of an engine or of a mapping: TOML with every key explained.

    Args:
        engine: what `load` has returned, or a mapping of sections.
        path: where to write it too; it appears whole or not at all.

    Raises:
        InputError: the mapping is wrong, or the engine was made of numbers: it has no file.
        OutputError: the file cannot be written.

    >>> engine = load("gots-diesel")
    >>> text = dump(engine.with_(bore_mm=90))
    >>> load(text.encode()).geometry.bore
    0.09
    """
    text = set_file(to_mapping(loaded_of(engine)[1].model))
    if path is not None:
        from reports.shared.files import write_text

        write_text(_path("path", path), text)
    return text


def build(
    source: Input, folder: Path | str = ".", *, only: Sequence[Kind] = (), name: str = ""
) -> tuple[Path, ...]:
    """Write the workbook, the report and other documents of an engine, as ``kshm build`` does.

    Args:
        source: what `load` takes, or an engine that it has returned.
        folder: where to write.
        only: kinds of documents, ``"xlsx"``, ``"pdf"``, ``"html"``, ``"docx"``, ``"sheet"``; by
            default those that the input names, else workbook and PDF.
        name: what the files are called, by default as the input.

    Returns:
        The paths of the files.

    Raises:
        InputError: the input is wrong, or a kind is none.
        OutputError: a file cannot be written.
        SystemPartMissing: a part of the system is missing: pango for PDF.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     [path.name for path in build("gots-diesel", folder, only=["xlsx"])]
    ['gots-diesel.xlsx']
    """
    path, loaded = loaded_of(source)
    built = _built(path, loaded, _path("folder", folder), only, name)
    if built.missing is not None:
        raise built.missing
    return built.files


def _path(name: str, path: object) -> Path:
    if not isinstance(path, str | Path):
        raise InputError(Problem(name, f"нужен путь, а задано: {type(path).__name__}"))
    return Path(path)


def _built(path: Path, loaded: Loaded, folder: Path, only: Sequence[Kind], name: str) -> Built:
    from reports.exports.build import ENDINGS
    from reports.exports.build import build as build_documents

    if not isinstance(name, str):
        raise InputError(Problem("name", f"нужен текст, а задано: {type(name).__name__}"))
    wrong = [kind for kind in only if kind not in ENDINGS] if isinstance(only, Sequence) else [only]
    if isinstance(only, str) or wrong:
        problem = f"нет вида документа «{one_line(str(wrong[0]), 40)}»"
        raise InputError(Problem("only", problem, f"есть: {', '.join(ENDINGS)}"))
    target = path.with_name(f"{name}.toml") if name else path
    return build_documents(target, loaded, folder, kinds_of(loaded, tuple(only)))
