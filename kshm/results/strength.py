"""Strength of one engine's piston, ring, pin, rod, bolts and webs by the loads of the chain."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import cos

import numpy as np

from kshm.arrays import Array, Columns, Results, Scalars
from kshm.defaults import (
    ALUMINIUM_EXPANSION,
    BUSH_EXPANSION,
    CAP_SHARE,
    EYE_SHARE,
    GROOVE_SHARE,
    IRON_EXPANSION,
    PISTON_SHARE,
    SIZES_C,
    TURN_SHARE,
)
from kshm.engine.masses import RodMasses
from kshm.engine.strength import PartStrength, Steel
from kshm.mechanics import strength as parts
from kshm.mechanics.strength import Pin, SectionLoad, StressCycle
from kshm.mechanics.webs import web_thickness, web_width
from kshm.results.case import Case
from kshm.results.forces import bending_forces

_RING_STEP = 30.0  # of the ring's pressure [deg]


def strength_results(case: Case) -> Results:
    """Tables ``ring_pressure``, ``webs_load`` and scalars ``st_…``; SI; empty without [strength].

    Two-stroke engines have ``rod_load`` too; split crankpins have no webs.
    """
    inputs = case.engine.strength
    if inputs is None:
        return {}, {}
    study = _Study(case, inputs)
    ring, web = study.ring(), study.webs()
    scalars = (
        study.loads() | study.size_scalars() | study.piston() | ring[1] | study.pin_scalars()
        | study.eye() | study.shank() | study.cap() | study.bolts() | web[1]
    )  # fmt: skip
    return ring[0] | study.rod_table() | web[0], scalars


@dataclass(frozen=True)
class _Study:
    """Parts of one engine; every method gives scalars in SI by their keys."""

    case: Case
    inputs: PartStrength

    @cached_property
    def sizes(self) -> dict[str, float]:
        """Sizes by name [m], with the shaft's webs, the thinnest of them."""
        engine = self.case.engine
        sizes = self.inputs.sizes(engine.geometry.bore, engine.crankshaft.pin_diameters[0])
        webs = {"web_width": web_width(engine), "web_thickness": float(web_thickness(engine).min())}
        return sizes | webs

    @cached_property
    def masses(self) -> Scalars:
        """Piston with its pin, the rest of the reciprocating mass, the cap, m_j and m_2 [kg]."""
        engine, batch, index = self.case.engine, self.case.raw.batch, self.case.index
        moving, turning = (float(mass[index, 0, 0]) for mass in (batch.m_j, batch.m_2))
        stated, masses = self.inputs.piston, engine.masses
        if isinstance(masses, RodMasses):
            usual = masses.piston_group
        else:  # what the assumed share of the rod leaves, as the moment of inertia has it
            share = engine.balancing.rod_small_end_share
            usual = max(PISTON_SHARE * moving, moving - share * turning / (1 - share))
        piston = usual if stated is None else stated
        return {
            "piston": piston, "rod": moving - piston, "cap": CAP_SHARE * turning,
            "moving": moving, "turning": turning,
        }  # fmt: skip

    @property
    def omega(self) -> float:
        """Angular speed of the regime [rad/s]."""
        return self.case.engine.omega

    @property
    def fastest(self) -> float:
        """Greatest angular speed ω_max [rad/s]."""
        return self.inputs.speed_factor * self.omega

    def swing(self, mass: float, omega: float) -> float:
        """Size of the inertia force at TDC m r ω²(1 + λ) [N]."""
        size = self.case.engine.geometry
        return mass * size.crank_radius * omega**2 * (1 + size.lam)

    def of_cylinder(self, values: Array) -> Array:
        """Force [N] of cylinder 1 over the cycle from its specific values [Pa], (angles,)."""
        forces: Array = self.case.engine.geometry.piston_area * values[self.case.index, 0]
        return forces

    @cached_property
    def peak(self) -> float:
        """Greatest gas pressure over that under the piston [Pa]."""
        return float(self.case.raw.p_gas[self.case.index, 0].max())

    @cached_property
    def gas(self) -> float:
        """Greatest gas force [N]."""
        return self.case.engine.geometry.piston_area * self.peak

    @cached_property
    def tearing(self) -> float:
        """Inertia force that tears the big end open at ω_max: its cap stays on the crankpin [N]."""
        mass, radius = self.masses, self.case.engine.geometry.crank_radius
        below = mass["turning"] - mass["cap"]
        turned = below * radius * self.fastest**2
        return self.swing(mass["moving"], self.fastest) + turned

    def loads(self) -> Scalars:
        """Return forces and masses that the parts are calculated for."""
        mass = self.masses
        return {
            "st_omega_max": self.fastest,
            "st_pz_MPa": self.peak,
            "st_Pz_N": self.gas,
            "st_m_piston": mass["piston"],
            "st_m_rod1": mass["rod"],
            "st_m_cap": mass["cap"],
            "st_Pj_N": self.swing(mass["piston"], self.omega),
            "st_Pj_max_N": self.swing(mass["piston"], self.fastest),
            "st_Pj_rod_N": self.tearing,
            "st_N_max_N": float(np.abs(self.of_cylinder(self.case.raw.N)).max()),
        }

    def size_scalars(self) -> Scalars:
        """Sizes, given or usual."""
        sizes = self.sizes.items()
        return {f"st_{key}_mm": size for key, size in sizes if key not in ("bore", "crankpin")}

    @cached_property
    def inner(self) -> float:
        """Inner diameter of the piston's head [m]."""
        size = self.sizes
        wall = size["head_wall"] + size["ring_radial"] + self.inputs.ring_play
        return size["bore"] - 2 * wall

    def piston(self) -> Scalars:
        """Crown, section of the oil ring's groove, first land, skirt, hot plays."""
        size, bore, side = self.sizes, self.sizes["bore"], self.loads()["st_N_max_N"]
        slenderness = self.inner / size["crown"]
        crown = self.peak * (slenderness / 2) ** 2
        groove = bore - 2 * (size["ring_radial"] + self.inputs.ring_play)
        ring = np.pi * (groove - self.inner) / 2 * (groove + self.inner) / 2
        drilled = self.inputs.oil_holes * self.inputs.oil_hole * (groove - self.inner) / 2
        shear, bending, land = parts.land_stresses(self.peak, bore, size["land"])
        pull = GROOVE_SHARE * self.swing(self.masses["piston"], self.fastest)
        return {
            "st_inner_mm": self.inner,
            # Both forms are one: 0.25 p(d/δ)² is p(r/δ)².
            "st_crown_MPa": crown,
            "st_groove_mm": groove,
            "st_groove_cm2": ring - drilled,
            "st_press_MPa": self.gas / (ring - drilled),
            "st_pull_MPa": pull / (ring - drilled),
            "st_land_shear_MPa": shear,
            "st_land_bend_MPa": bending,
            "st_land_MPa": land,
            "st_q1_MPa": side / (size["skirt"] * bore),
            "st_q2_MPa": side / (size["height"] * bore),
        } | self._plays()

    def _plays(self) -> Scalars:
        """Hot plays of head and skirt [m]: the cylinder's bore less the piston's diameter."""
        inputs, bore = self.inputs, self.sizes["bore"]
        iron = inputs.piston_material == "iron"
        piston = IRON_EXPANSION if iron else ALUMINIUM_EXPANSION
        cylinder = bore * (1 + IRON_EXPANSION * (inputs.cylinder_temperature - SIZES_C))
        return {
            f"st_hot_{part}_mm": cylinder - bore * (1 - play) * (1 + piston * (warm - SIZES_C))
            for part, play, warm in (
                ("head", inputs.head_play, inputs.head_temperature),
                ("skirt", inputs.skirt_play, inputs.skirt_temperature),
            )
        }

    def ring(self) -> Results:
        """Pressure of the ring by the angle from its middle; stresses."""
        radial = self.sizes["ring_radial"]
        gap, slenderness = self.sizes["ring_gap"] / radial, self.sizes["bore"] / radial
        modulus = self.inputs.ring_modulus
        mean = parts.ring_pressure(modulus, gap, slenderness)
        work, put = parts.ring_stresses(mean, modulus, gap, slenderness)
        angle = np.arange(0.0, 360.0 + _RING_STEP, _RING_STEP)
        share = parts.between(180 - np.abs(180 - angle), parts.RING)
        table = {
            "st_ring_deg": np.radians(angle), "st_ring_mu": share, "st_ring_p_MPa": share * mean,
        }  # fmt: skip
        scalars = {"st_ring_MPa": mean, "st_ring_work_MPa": work, "st_ring_put_MPa": put}
        return {"ring_pressure": table}, scalars

    def pin_scalars(self) -> Scalars:
        """Pressures, bending, shear and ovality of the piston pin."""
        size, inputs = self.sizes, self.inputs
        swing = inputs.pin_share * self.swing(self.masses["piston"], self.omega)
        force = self.gas + (swing if inputs.pin_form == "plus" else -swing)
        pin = Pin(force, size["pin"], size["pin_bore"], size["pin_length"], inputs.pin_modulus)
        oval = pin.oval_stresses(curved=inputs.oval_form == "curved")
        names = ("out0", "in0", "out90", "in90")
        return {
            "st_alpha": pin.alpha,
            "st_pin_N": force,
            "st_pin_eye_MPa": force / (pin.outer * size["eye_length"]),
            "st_pin_boss_MPa": force / (pin.outer * (pin.length - size["bosses"])),
            "st_pin_bend_MPa": pin.bending(size["bosses"], size["eye_length"]),
            "st_pin_shear_MPa": pin.shear,
            "st_oval_mm": pin.ovality,
            "st_oval_A_MPa": pin.oval_unit,
            **{f"st_oval_{name}_MPa": each for name, each in zip(names, oval, strict=True)},
        }

    @cached_property
    def eye_bore(self) -> float:
        """Inner diameter of the eye, over the bush [m]."""
        return self.sizes["pin"] + 2 * self.sizes["bush_wall"]

    def _bush(self) -> Scalars:
        """Pressure of the bush in the eye and the hoop stress of the eye outside and inside."""
        inputs, steel = self.inputs, self.inputs.rod_material
        radii = self.sizes["pin"] / 2, self.eye_bore / 2, self.sizes["eye_outer"] / 2
        grown = self.eye_bore * (BUSH_EXPANSION - steel.expansion) * inputs.bush_warming
        moduli = inputs.bush_modulus, steel.modulus
        pressure = parts.fit_pressure(inputs.bush_fit + max(0.0, grown), radii, moduli)
        inside, outside = parts.hoop_stresses(pressure, *radii[1:])
        gap = inputs.bush_fit + max(0.0, grown)
        bush, common, eye = radii
        return {
            "st_bush_gap_mm": gap, "st_bush_MPa": pressure,
            "st_bush_eye": parts.compliance(common, eye),
            "st_bush_ring": -parts.compliance(common, bush),
            "st_bush_out_MPa": outside, "st_bush_in_MPa": inside,
        }  # fmt: skip

    def eye(self) -> Scalars:
        """Section I-I, bush, bending of the eye when it is drawn and pressed, safety."""
        size, inputs, mass = self.sizes, self.inputs, self.masses
        wall, radius = (size["eye_outer"] - self.eye_bore) / 2, self._eye_radius
        pulled = self.swing(mass["piston"] + EYE_SHARE * mass["rod"], self.fastest)
        top, bush = pulled / (2 * wall * size["eye_length"]), self._bush()
        stiff, soft = wall * inputs.rod_material.modulus, size["bush_wall"] * inputs.bush_modulus
        share = stiff / (stiff + soft)
        drawn_by = self.swing(mass["piston"], self.fastest)
        pressed_by = self.gas - self.swing(mass["piston"], self.omega)
        scalars, stresses = Scalars(), []
        for name, force, drawn in (("draw", drawn_by, True), ("squeeze", pressed_by, False)):
            at_top = parts.eye_top(force, radius, float(np.degrees(inputs.embedding)), drawn=drawn)
            at = parts.eye_section(at_top, force, radius, inputs.embedding, drawn=drawn)
            stress = parts.outer_fibre(at, radius, wall, size["eye_length"], share)
            stresses.append(stress + bush["st_bush_out_MPa"])
            scalars |= {f"st_{name}_N0": at_top.force, f"st_{name}_M0": at_top.moment,
                        f"st_{name}_N": at.force, f"st_{name}_M": at.moment,
                        f"st_{name}_MPa": stress}  # fmt: skip
        turned = parts.eye_section(SectionLoad(0.0, 0.0), 1.0, 1.0, inputs.embedding, drawn=False)
        unit = parts.eye_top(1.0, 1.0, float(np.degrees(inputs.embedding)), drawn=False)
        return bush | scalars | {
            "st_squeeze_P_N": pressed_by, "st_squeeze_J": turned.force,
            "st_squeeze_kN": unit.force, "st_squeeze_kM": -unit.moment,
            "st_eye_bore_mm": self.eye_bore, "st_eye_wall_mm": wall, "st_eye_mean_mm": radius,
            "st_eye_top_MPa": top, "st_eye_K": share,
            **self._fatigue("eye_top", top, 0.0), **self._fatigue("eye", stresses[0], stresses[1]),
        }  # fmt: skip

    @property
    def _eye_radius(self) -> float:
        return (self.sizes["eye_outer"] + self.eye_bore) / 4

    def _fatigue(
        self, name: str, most: float, least: float, part: str = "rod", safety_key: str = ""
    ) -> Scalars:
        """Amplitude and mean of a stress [Pa], safety of the steel under it."""
        steel: Steel = getattr(self.inputs, f"{part}_material")
        k = getattr(self.inputs, f"{part}_concentration")
        cycle = StressCycle.of(most, least)
        safety = cycle.safety((steel.pull, steel.yielding), k, self.inputs.mean_factor)
        return {
            f"st_{name}_a_MPa": cycle.amplitude, f"st_{name}_m_MPa": cycle.mean,
            safety_key or f"st_{name}_n": safety,
        }  # fmt: skip

    @cached_property
    def rod_force(self) -> Array:
        """Gas and inertia force along the cylinder at ω_max [N], (angles,)."""
        raw = self.case.raw
        grown = self.inputs.speed_factor**2
        return self.of_cylinder(raw.p_gas) + grown * self.of_cylinder(raw.p_inertia)

    @property
    def _exchanges(self) -> bool:
        """Whether the engine has a TDC of gas exchange, where the rod is drawn."""
        return self.case.engine.strokes == 4

    def rod_table(self) -> dict[str, Columns]:
        """Force on the rod over the cycle of an engine that burns at each TDC."""
        if self._exchanges:
            return {}
        return {"rod_load": {"phi_deg": self.case.raw.phi, "st_rod_N": self.rod_force}}

    def shank(self) -> Scalars:
        """Return forces on the shank, its section, buckling, safety in both planes."""
        engine, size, steel = self.case.engine, self.sizes, self.inputs.rod_material
        moving, rod = self.masses["moving"], engine.geometry.rod_length
        pressed = self.gas - self.swing(moving, self.omega)
        at_exchange = float(self.of_cylinder(self.case.raw.p_gas)[0])
        drawn = at_exchange - self.swing(moving, self.fastest)
        if not self._exchanges:
            drawn = float(self.rod_force.min())
        area, tall, wide = parts.i_section(
            *(size[f"shank_{key}"] for key in ("height", "width", "web", "flange"))
        )
        between_eyes = rod - (self.eye_bore + size["crankpin"]) / 2
        # Across the swinging the ends are clamped: half the length between the eyes.
        factors = [parts.column_factor(steel.tensile, area, second, length, steel.modulus)
                   for second, length in ((tall, rod), (wide, between_eyes / 2))]  # fmt: skip
        most, least = [factor * pressed / area for factor in factors], drawn / area
        cycles = Scalars()
        for plane, stress in zip("xy", most, strict=True):
            key = f"st_shank_n{plane}"
            cycles |= self._fatigue(f"shank_{plane}", stress, least, safety_key=key)
        gas = {"st_Pg_tdc_N": at_exchange} if self._exchanges else {}
        return gas | cycles | {
            "st_squeezed_N": pressed, "st_drawn_N": drawn, "st_shank_cm2": area,
            "st_shank_Jx": tall, "st_shank_Jy": wide,
            "st_shank_Kx": factors[0], "st_shank_Ky": factors[1],
            "st_shank_x_MPa": most[0], "st_shank_y_MPa": most[1], "st_shank_min_MPa": least,
        }  # fmt: skip

    def cap(self) -> Scalars:
        """Cap of the big end with its shell."""
        size, distance = self.sizes, self.sizes["bolts_apart"]
        wall = (distance - size["crankpin"]) / 2 - size["shell"]
        modulus, stiffness = size["cap_length"] * wall**2 / 6, (size["shell"] / wall) ** 3
        area = size["cap_length"] * (wall + size["shell"])
        bent = 0.023 * distance / ((1 + stiffness) * modulus)
        return {
            "st_cap_wall_mm": wall, "st_cap_W": modulus, "st_cap_J": stiffness,
            "st_cap_cm2": area, "st_cap_MPa": self.tearing * (bent + 0.4 / area),
        }  # fmt: skip

    def bolts(self) -> Scalars:
        """Return a bolt of the big end: tightened, and loaded by a share of its force."""
        inputs, core = self.inputs, self.sizes["bolt"] - 1.4 * self.inputs.bolt_pitch
        each = self.tearing / inputs.bolts
        preload = inputs.bolt_preload * each
        shared = 1.0 if inputs.bolt_form == "each" else inputs.bolts
        most = preload + inputs.bolt_share * each / shared
        area = np.pi / 4 * core**2
        return {
            "st_bolt_core_mm": core, "st_bolt_preload_N": preload, "st_bolt_load_N": most,
            "st_bolt_max_MPa": most / area, "st_bolt_min_MPa": preload / area,
            **self._fatigue("bolt", most / area, preload / area, "bolt"),
        }  # fmt: skip

    def webs(self) -> Results:
        """Torsion and bending of the left web of every throw over the cycle, safety."""
        engine = self.case.engine
        if any(cylinder.pin_angle for cylinder in engine.arrangement):
            return {}, {}
        longer, shorter = sorted((self.sizes["web_width"], self.sizes["web_thickness"]))[::-1]
        ratio = longer / shorter
        factor = parts.torsion_factor(ratio)
        modulus = factor * longer * shorter**2
        table: Columns = {"phi_deg": self.case.raw.phi}
        scalars = {"st_web_ratio": ratio, "st_web_rho": factor, "st_web_W": modulus}
        for number in range(1, len(engine.crankshaft.throws) + 1):
            twist, bend = self._web(number - 1)
            table |= {f"st_web_twist{number}_Nm": twist, f"st_web_bend{number}_MPa": bend}
            scalars |= self._web_safety(number, twist / modulus, bend)
        least = min(scalars[f"st_web_n{k}"] for k in range(1, len(engine.crankshaft.throws) + 1))
        return {"webs_load": table}, scalars | {"st_web_n": least}

    def _web(self, throw: int) -> tuple[Array, Array]:
        """Torque [N·m] and normal stress [Pa] of a left web.

        Half of the load acts on the web's arm; of the counterweights the support's reaction alone
        bends it: they stand on the support's side of the section and do not press it.
        """
        engine, size = self.case.engine, self.sizes
        arm = engine.crankshaft.throws[throw].places.left_web
        inward, ahead, _ = bending_forces(self.case, throw)
        half = engine.geometry.piston_area / 2
        section = size["web_width"] * size["web_thickness"]
        moment = (half * inward + self._weights(throw)) * arm
        bend = moment / (section * size["web_thickness"] / 6) + half * inward / section
        return half * ahead * arm, bend

    def _weights(self, throw: int) -> float:
        """Reaction of the left support along the crank to a throw's counterweights [N]."""
        engine, crank = self.case.engine, self.case.engine.crankshaft.throws[throw]
        unit, length = engine.geometry.crank_radius * engine.omega**2, crank.places.length
        webs = ((crank.left_web, crank.places.left_web), (crank.right_web, crank.places.right_web))
        return sum(
            web.counterweight_mass * unit * cos(web.counterweight_angle) * (1 - at / length)
            for web, at in webs
        )

    def _web_safety(self, number: int, tau: Array, sigma: Array) -> Scalars:
        steel, inputs = self.inputs.web_material, self.inputs
        scalars, safeties = Scalars(), []
        for way, stress, limit in (
            ("tau", tau, TURN_SHARE * steel.bending), ("sig", sigma, steel.bending),
        ):  # fmt: skip
            most, least = float(stress.max()), float(stress.min())
            cycle = StressCycle.of(most, least)
            worn = inputs.web_concentration * cycle.amplitude
            safeties.append(limit / (worn + inputs.mean_factor * abs(cycle.mean)))
            scalars |= {f"st_web_{way}_max{number}_MPa": most,
                        f"st_web_{way}_min{number}_MPa": least,
                        f"st_web_n_{way}{number}": safeties[-1]}  # fmt: skip
        turned, bent = safeties
        return scalars | {f"st_web_n{number}": turned * bent / float(np.hypot(turned, bent))}
