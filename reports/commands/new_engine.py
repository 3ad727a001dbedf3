"""``kshm new`` with --cylinders and --from: choose the engine and its scaling rules."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from reports.shared.errors import KshmError

if TYPE_CHECKING:
    from reports.inputs.sections.input_file import InputFile

# Power and speed, then what an alternative has by its rules.
_NUMBERS = (
    "power_kw", "speed_rpm", "bore_mm", "stroke_mm", "rod_mm", "lambda_", "compression",
    "efficiency",
)  # fmt: skip
Base = tuple[str, Callable[[], "InputFile"]]


def new_book(target: Path, others: Iterable[object]) -> str:
    """Return the text of a commented book of a department.

    Raises:
        KshmError: its name has another ending, or further options are given.
    """
    from reports.inputs.department_chapters import SUFFIX
    from reports.shared.resources import templates_dir

    if target.suffix != SUFFIX:
        raise KshmError(f"--book {target}: нужно окончание {SUFFIX}")
    if any(value not in (None, False) for value in others):
        raise KshmError("--book: других ключей не нужно; уберите их")
    return (templates_dir() / "own.book").read_text(encoding="utf-8")


def new_text(
    base: Base | None,
    *,
    sample: str | None,
    cylinders: int | None,
    strength: bool = False,
    cycle: bool = False,
    **options: Any,  # noqa: ANN401
) -> str:
    """Return the file of a sample, of an own engine, or of an alternative to ``base``.

    Args:
        base: Name of the engine of --from, and what reads it.
        sample: Value of --sample, which does not go with the other two.
        cylinders: Value of --cylinders.
        strength: Value of --strength, for an own engine.
        cycle: Value of --cycle, for an own engine.
        options: ``layout``, ``strokes``, ``kind`` and the numbers of a task; None is not given.

    Raises:
        KshmError: the options do not go together, or there is no such engine.
    """
    if cylinders is None and base is None:
        extra = [key for key, value in options.items() if value is not None]
        extra += ["strength"] * strength + ["cycle"] * cycle
        if extra:
            raise KshmError(f"{_option(extra[0])}: ключ для своего двигателя; добавьте --cylinders")
        from reports.inputs.template import new_file

        return new_file(sample)
    if sample is not None:
        other = "--from" if base is not None else "--cylinders"
        raise KshmError(f"--sample и {other} вместе не нужны; оставьте один из ключей")
    if cylinders is None:
        raise KshmError("--from: не указано число цилиндров варианта; добавьте --cylinders")
    for key in _NUMBERS:
        value = options.get(key)
        if value is not None and not (math.isfinite(value) and value > 0):
            raise KshmError(f"{_option(key)}: значение должно быть больше нуля")
    for key, is_set in (("strength", strength), ("cycle", cycle)):
        if base is not None and is_set:
            raise KshmError(f"--{key}: у варианта раздел тот же, что в основе; уберите ключ")
    if base is not None:
        return _alternative(base, cylinders, options)
    from reports.new.generate import file_text, generate_engine

    if options.get("rod_mm") is not None and options.get("lambda_") is not None:
        raise KshmError("--rod и --lambda вместе не нужны; оставьте один из ключей")
    kinds = {key: options[key] for key in ("layout", "kind") if options.get(key) is not None}
    numbers: dict[str, Any] = {key: options.get(key) for key in _NUMBERS}
    strokes = int(options.get("strokes") or 4)
    added: dict[str, Any] = {"strength": strength, "cycle": cycle}
    return file_text(generate_engine(cylinders, **kinds, strokes=strokes, **added, **numbers))


def _option(key: str) -> str:
    return "--" + key.partition("_")[0]


def _alternative(base: Base, cylinders: int, options: Mapping[str, Any]) -> str:
    from reports.new.generate import file_text
    from reports.new.scale_engine import alternative
    from reports.shared.russian import comma

    for key in ("strokes", "kind"):
        if options[key] is not None:
            raise KshmError(f"{_option(key)}: у варианта они те же, что в {base[0]}; уберите ключ")
    for key in _NUMBERS[2:]:
        if options.get(key) is not None:
            problem = f"у варианта следует из {base[0]} по подобию"
            raise KshmError(f"{_option(key)}: {problem}; уберите ключ или правьте файл")
    model = base[1]()
    speed, power, ratio, cause = options["speed_rpm"], options["power_kw"], 1.0, ""
    if power is not None:
        old = _power_kw(model)
        faster = 1.0 if speed is None else speed / model.regime.speed_rpm
        ratio = power / old / faster
        cause = comma(f"Мощность {power:g} кВт вместо {old:.4g} кВт при прежнем p_e")
    scaled = alternative(
        model, cylinders, layout=options["layout"], speed_rpm=speed, displacement=ratio, cause=cause
    )
    if power is not None and model.cycle is None:
        regime = model.regime
        stated = power / float(regime.mechanical_efficiency) * float(regime.fullness)
        scaled.data["regime"]["indicated_power_kw"] = round(stated, 3)
    return file_text(scaled)


def _power_kw(model: Any) -> float:  # noqa: ANN401 - the heavy import waits
    """Effective power N_e = N_i·η_м [kW] of the engine as it is computed."""
    from reports.inputs.solve_input import solved

    scalars = solved(model).scalars
    speed = float(model.regime.speed_rpm)
    return float(scalars["M_e"]) * speed * math.pi / 30 / 1000
