"""What ``kshm new`` does with --cylinders and --from: which engine, by which rules."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from reports.shared.errors import KshmError


def own_text(
    sample: str | None, base: Path | None, cylinders: int | None, wanted: Mapping[str, Any]
) -> str:
    """The file of an own engine, or of an alternative to that of ``base``.

    Args:
        sample: Value of --sample, which does not go with the other two.
        base: Value of --from.
        cylinders: Value of --cylinders.
        wanted: Values of --layout, --strokes, --kind, --power and --speed; None is not given.

    Raises:
        KshmError: the options do not go together, or there is no such engine.
    """
    if sample is not None:
        other = "--from" if base is not None else "--cylinders"
        raise KshmError(f"--sample и {other} вместе не нужны; оставьте один из ключей")
    if cylinders is None:
        raise KshmError("--from: не указано число цилиндров варианта; добавьте --cylinders")
    for key in ("--power", "--speed"):
        value = wanted[key]
        if value is not None and not (math.isfinite(value) and value > 0):
            raise KshmError(f"{key}: значение должно быть больше нуля")
    if base is not None:
        return _alternative(base, cylinders, wanted)
    from reports.inputs.own_engine import own_engine
    from reports.inputs.own_file import file_text

    made = own_engine(
        cylinders,
        layout=wanted["--layout"] or "inline",
        strokes=int(wanted["--strokes"] or 4),
        kind=wanted["--kind"] or "petrol",
        power_kw=wanted["--power"],
        speed_rpm=wanted["--speed"],
    )
    return file_text(made)


def _alternative(base: Path, cylinders: int, wanted: Mapping[str, Any]) -> str:
    from reports.commands.common import load
    from reports.inputs.own_file import file_text
    from reports.inputs.own_similar import alternative
    from reports.shared.russian import comma

    for key in ("--strokes", "--kind"):
        if wanted[key] is not None:
            raise KshmError(f"{key}: у варианта они те же, что в {base}; уберите ключ")
    model = load(base).model
    speed, power, ratio, cause = wanted["--speed"], wanted["--power"], 1.0, ""
    if power is not None:
        old = _power_kw(model)
        faster = 1.0 if speed is None else speed / model.regime.speed_rpm
        ratio = power / old / faster
        cause = comma(f"Мощность {power:g} кВт вместо {old:.4g} кВт при прежнем p_e")
    return file_text(
        alternative(
            model,
            cylinders,
            layout=wanted["--layout"],
            speed_rpm=speed,
            displacement=ratio,
            cause=cause,
        )
    )


def _power_kw(model: Any) -> float:  # noqa: ANN401 - the heavy import waits
    """Effective power N_e = N_i·η_м [kW] of the engine as it is computed."""
    from reports.inputs.solved import solved

    found = solved(model).scalars
    speed = float(model.regime.speed_rpm)
    return float(found["M_e"]) * speed * math.pi / 30 / 1000
