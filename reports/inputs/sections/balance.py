"""The [balance] section of the input file: counterweights, balance shafts, flywheel."""

from __future__ import annotations

from pydantic import model_validator

from reports.inputs.meta import Strictly, number
from reports.inputs.units import MM, NONE

_SHARES = {"counterweight_share", "first_shafts_share", "second_shafts_share"}


class BalanceSection(Strictly):
    """[balance]: every key has a default, a change takes effect in the open workbook."""

    counterweight_share: float = number(
        "Доля сил инерции 1-го порядка на противовесах колен", "ε_п", NONE, 0, 1, 0.5
    )
    first_shafts_share: float = number(
        "Доля силы 1-го порядка, снятая балансирными валами", "ψ_1", NONE, 0, 1, 0.0
    )
    second_shafts_share: float = number(
        "Доля силы 2-го порядка, снятая балансирными валами", "ψ_2", NONE, 0, 1, 1.0
    )
    suppression: float = number(
        "Степень гашения опрокидывающего момента 2-го порядка", "ψ", NONE, 0, 2, 0.5
    )
    shaft_radius_mm: float = number(
        "Эксцентриситет грузов балансирных валов", "e_б", MM, 1, 1000, 20.0
    )
    irregularity: float = number(
        "Требуемая неравномерность хода", "[δ_х]", NONE, 0.0001, 0.5, 0.015
    )
    rod_small_end_share: float = number(
        "Доля массы шатуна у пальца, если масса шатуна не задана", "m_1/m_ш", NONE, 0.05, 0.8, 0.275
    )
    rod_mass_factor: float = number(
        "Момент инерции шатуна к моменту двух замещающих масс", "k_ш", NONE, 0.2, 2, 1.0
    )
    web_width_share: float = number("Ширина щеки к диаметру цилиндра", "b/D", NONE, 0.3, 3, 1.125)
    web_thickness_share: float = number(
        "Толщина щеки к диаметру цилиндра", "h/D", NONE, 0.03, 1, 0.175
    )

    @model_validator(mode="before")
    @classmethod
    def _only_what_is_named(cls, given: object) -> object:
        """Who names one device has no others: their usual shares are for who names none."""
        if isinstance(given, dict) and _SHARES & given.keys():
            return dict.fromkeys(_SHARES, 0.0) | given
        return given

    @property
    def asked(self) -> set[str]:
        """Keys that a person chose: given one by one, or other than the defaults.

        A file that a program wrote out gives them all.
        """
        fields = type(self).model_fields
        if self.model_fields_set < fields.keys():
            return set(self.model_fields_set)
        return {key for key, field in fields.items() if getattr(self, key) != field.default}
