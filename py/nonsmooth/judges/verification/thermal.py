"""Slip surfaces that heat, each law alone (Taboada and Estrada 2009, section 4.3): pressurized pore water,
microcontacts, a reaction, melt and a table, against closed forms and other solvers.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import erfcx

from ...figures import style
from ...figures.sliding_block import sliding_block
from ...slip import block, laws, parameter_sets
from .claims import Claims, Findings
from .registry import check
from .thermal_references import (
    DIFFUSING,
    DRAINING,
    G,
    GENTLE,
    MELT,
    ROCK,
    STEAM,
    WATER,
    ZONE,
    layer,
    melting,
    undrained,
)

#: Steps of the check of a scene's, and the fine one [s].
STEPS = (1e-2, 5e-3, 1e-3)
SCHEME = "the scheme's: first order in the step, 1.3 % at 10 ms"


def law_of(names, values, **changed):
    """A SlipLaw of a set of values, some of them changed."""
    return laws.SlipLaw(names, **{**values, **changed})


def at_share(course, share):
    """Time [s], slip [m] and speed [m/s] at which a block's strength has fallen to a share of f σ, between two
    steps.
    """
    tau = course["strength_Pa"] / course["strength_Pa"][0]
    k = int(np.argmax(tau < share))
    w = (tau[k - 1] - share) / (tau[k - 1] - tau[k])
    return [float(course[n][k - 1] + w * (course[n][k] - course[n][k - 1])) for n in list(course)[:3]]


@check("A block on a zone that keeps heat and water", subject="Slip surfaces that heat", seconds=2)
def adiabatic_block(bench):
    """A zone of the thickness h from which neither heat nor water leaves (eqs 10 to 13 without fluxes): the pressure
    rises by Λ with temperature, and temperature by τ dδ/(ρc h). So τ = f σ exp(−δ/D_c), D_c = ρc h/(f Λ), and T rises
    by (σ/Λ)(1 − τ/fσ). On a slope v² = v₀² + 2g[δ sin β − f cos β D_c (1 − exp(−δ/D_c))]; a block that would stop
    does so where strength equals weight, at d* = D_c ln(f cos β/sin β), unless its first speed carries it over.
    """
    claims, courses = Claims(), []
    for step in STEPS:
        course = block.slide(law_of(WATER, ZONE), ROCK, step, block.Until(share=0.01))
        why = SCHEME if step > 1e-3 else "asked for; the step of 1 ms makes 0.2 %"
        for share in (0.1, 0.01):
            exact = undrained(ZONE, ROCK, share)
            for name, value, known in zip(("time [s]", "slip [m]", "speed [m/s]"), at_share(course, share), exact):
                what = f"{step * 1e3:g} ms: at {share:.0%} of strength: {name}"
                claims.near(what, value, known, why, relative=0.01 if step < 1e-2 else 0.02)
        rise = course["temperature_degC"][-1] - ZONE["temperature"]
        claims.near(f"{step * 1e3:g} ms: temperature rise at 1 % of strength [K]", rise, 32.26, why, relative=0.01)
        balance = 1e-3 * (course["heat_J_per_m2"][-1] / (2.85e6 * 0.01 * rise) - 1)
        claims.near(
            f"{step * 1e3:g} ms: heat of the block over that of the zone, less 1",
            balance,
            0,
            "rounding",
            absolute=1e-12,
        )
        courses.append((f"{step * 1e3:g} ms", course))
    gentle = law_of(WATER, ZONE, friction=0.35)
    critical = 2.85e6 * 0.01 / (0.35 * 6.7e4)
    turn = critical * math.log(0.35 * math.cos(math.radians(15)) / math.sin(math.radians(15)))
    held = 0.35 * math.cos(math.radians(15)) * critical * (1 - math.exp(-turn / critical))
    exact = math.sqrt(2 * G * (held - math.sin(math.radians(15)) * turn))
    step = 5e-3 if bench.quick else 1e-3
    low, high = 0.4, 0.6
    while high - low > 1e-4:
        middle = 0.5 * (low + high)
        end = block.slide(gentle, block.OnSlope(**GENTLE, speed=middle), step, block.Until(time=60, share=0.05))
        low, high = (middle, high) if end["speed_m_per_s"][-1] == 0 else (low, middle)
    claims.near("15°: least speed that runs away [m/s]", low, exact, "asked for; bisected to 1e-4", relative=0.01)
    claims.near("the same, as printed [m/s]", exact, 0.4911, "four digits", relative=1e-4, against="literature")
    slip = np.linspace(0, 6, 200)
    forms = [("closed form", slip, np.exp(-slip / (2.85e6 * 0.01 / (0.4 * 6.7e4))))]
    return Findings(claims, plots=[(sliding_block(courses, closed_forms=forms), "The block at three steps.")])


@check("Slip on a plane", subject="Slip surfaces that heat", seconds=1)
def slip_on_a_plane(bench):
    """Heat on a plane at constant V, diffusing into both sides with water that leaves: τ = f σ exp(x²) erfc(x), x² =
    δ/L*, L* = (4/f²)(ρc/Λ)² (√α_hy + √α_th)²/V (Rice 2006). The law takes steps that grow with time, from far below
    the first slip that is looked at; strengths are those at the ends of steps, over four decades of slip.
    """
    f, sigma, capacity, rise, hydraulic, thermal, speed = 0.25, 126e6, 2.7e6, 0.92e6, 0.86e-6, 0.70e-6, 1.0
    length = 4 / f**2 * (capacity / rise) ** 2 * (math.sqrt(hydraulic) + math.sqrt(thermal)) ** 2 / speed
    claims = Claims()
    claims.near("L* [mm]", 1e3 * length, 1.7153, "printed digits", relative=1e-4, against="literature")
    first, last = 0.01 * length / speed, 100 * length / speed
    law = laws.SlipLaw(
        WATER,
        friction=f,
        thickness=0,
        heat_capacity=capacity,
        thermal_diffusivity=thermal,
        hydraulic_diffusivity=hydraulic,
        pressurization_coefficient=rise,
        temperature=210,
        water_pressure=70e6,
        duration=last,
        finest_node=0.3 * math.sqrt(thermal * first),
        node_growth=1.3,
    )
    cells, time, rows = law.cells(1, sigma), 0.0, []
    cells.slip_rate[:] = speed
    for after in np.geomspace(1e-3 * first, last, (40 if bench.quick else 80) * 7 + 1):
        h = after - time
        law.prepare(h)
        strength = float(law.strength(cells)[0])
        cells.path[:], cells.heat[:] = speed * h, strength * speed * h
        law.advance(cells)
        time = after
        rows.append((speed * time, f * max(sigma - cells.columns["pressure"][0, 0], 0)))
    slip, tau = np.array(rows).T
    exact = f * sigma * erfcx(np.sqrt(slip / length))
    seen = slip >= 0.0099 * length
    off = np.abs(tau / exact - 1)[seen].max()
    claims.at_most("largest error from 0.01 to 100 L*", off, 0.01, "asked for; nodes and steps")
    for place, known in zip((0.01, 0.1, 1, 10, 100), (0.896457, 0.723578, 0.427584, 0.170578, 0.056141)):
        found = np.interp(place, slip / length, tau) / (f * sigma)
        claims.near(f"strength at {place:g} L*", found, known, "asked for", relative=0.01)
    figure = style.figure(6.4, 3.4, layout="constrained")
    axes = figure.subplots()
    axes.loglog(slip / length, tau / (f * sigma), color=style.LINES["blue"], label="the law")
    axes.loglog(slip / length, exact / (f * sigma), color=style.LINES["orange"], ls=":", label="closed form")
    axes.set(xlabel="slip by L*", ylabel="strength by its first value", xlim=(1e-3, 100), ylim=(0.03, 1.2))
    axes.legend(frameon=False)
    return Findings(claims, plots=[(figure, "Slip on a plane.")])


@check("A block on a zone that leaks heat and water", subject="Slip surfaces that heat", seconds=20, quick=4)
def leaking_block(bench):
    """The same zones with diffusion (eqs 10 to 13), which no closed form has. Another program integrated the equations
    with adaptive BDF steps and 160 nodes in half of the zone. A zone through which water leaves heats more and weakens
    later, and beyond a critical permeability a block that was started comes to rest.
    """
    claims, courses, table = Claims(against="BDF, 160 nodes"), [], []
    step = 5e-3 if bench.quick else 1e-3
    leaks = dict(thermal_diffusivity=1.45e-7, hydraulic_diffusivity=7e-8)
    course = block.slide(law_of(WATER, ZONE, **leaks), ROCK, step, block.Until(share=0.009))
    for share, *known in DIFFUSING:
        found = at_share(course, share)
        warm = np.interp(found[1], course["slip_m"], course["temperature_degC"]) - ZONE["temperature"]
        for name, value, exact in zip(("time [s]", "slip [m]", "speed [m/s]", "rise [K]"), (*found, warm), known):
            claims.near(f"10 mm: at {share:.0%} of strength: {name}", value, exact, "asked for", relative=0.03)
        table.append((f"{share:.0%}", *(f"{v:.3f}" for v in (*found, warm)), *(f"{v:.3f}" for v in known)))
    courses.append(("10 mm, 7e-8 m²/s", course))
    for hydraulic, slip, rise in DRAINING:
        bench.progress(f"1.4 mm, {hydraulic:g} m²/s")
        thin = dict(friction=math.tan(math.radians(22)), thickness=1.4e-3, hydraulic_diffusivity=hydraulic)
        course = block.slide(law_of(WATER, ZONE, **{**leaks, **thin}), ROCK, step, block.Until(share=0.045))
        found = at_share(course, 0.05)[1]
        warm = np.interp(found, course["slip_m"], course["temperature_degC"]) - ZONE["temperature"]
        claims.near(f"1.4 mm, {hydraulic:g} m²/s: slip at 5 % of strength [m]", found, slip, "asked for", relative=0.03)
        claims.near("the same: mean temperature rise [K]", warm, rise, "asked for", relative=0.03)
        courses.append((f"1.4 mm, {hydraulic:g} m²/s", course))

    def runs_away(hydraulic):
        law = law_of(WATER, ZONE, friction=0.35, thermal_diffusivity=1.45e-7, hydraulic_diffusivity=hydraulic)
        return block.slide(law, block.OnSlope(**GENTLE, speed=1.0), step, block.Until(time=30, share=0.02))

    stopped = runs_away(1e-3)
    claims.near("1e-3 m²/s: time to rest [s]", stopped["time_s"][-1], 1.788, "a step and the scheme", relative=0.01)
    claims.near("1e-3 m²/s: slip to rest [m]", stopped["slip_m"][-1], 0.8686, "a step and the scheme", relative=0.01)
    low, high = 1e-4, 1e-3
    for _ in range(6 if bench.quick else 10):
        middle = math.sqrt(low * high)
        low, high = (low, middle) if runs_away(middle)["speed_m_per_s"][-1] == 0 else (middle, high)
    claims.near("critical hydraulic diffusivity [m²/s]", math.sqrt(low * high), 1.988e-4, "asked for", relative=0.1)
    heads = (
        "strength",
        "time [s]",
        "slip [m]",
        "speed [m/s]",
        "rise [K]",
        *(f"{n}, BDF" for n in ("time", "slip", "speed", "rise")),
    )
    return Findings(
        claims,
        plots=[(sliding_block(courses), "Zones through which more and less water leaves.")],
        tables=[("The zone of 10 mm.", heads, table)],
    )


@check("Flash heating", subject="Slip surfaces that heat", seconds=1)
def flash_heating(bench):
    """Contacts weaken beyond V_w = (π α_th/D_a)[ρc (T_w − T)/τ_c]² (eq. 15), with the paper's values 0.2061 m/s, and
    there f = f_w + (f₀ − f_w) V_w/V (Rice 2006). Heat of the zone lowers V_w; half-way to T_w it is a quarter.
    """
    law = parameter_sets.law("fault_gouge")
    claims, speeds = Claims(), np.geomspace(0.01, 100, 201)
    fast = math.pi * 0.5e-6 / 5e-6 * (2.7e6 * 900 / 3e9) ** 2
    claims.near("V_w of eq. 15 [m/s]", law.flash_velocity(15), fast, "rounding", relative=1e-12)
    claims.near(
        "the same, as printed [m/s]", law.flash_velocity(15), 0.2061, "four digits", relative=3e-4, against="literature"
    )
    claims.near("V_w half-way to T_w [m/s]", law.flash_velocity(465), fast / 4, "rounding", relative=1e-12)
    cells = law.cells(len(speeds), 1.0)
    cells.slip_rate[:] = speeds
    law.prepare(1e-3)
    friction = law.strength(cells).copy()
    exact = np.where(speeds > fast, 0.12 + 0.48 * fast / speeds, 0.6)
    claims.at_most("largest error of f from 0.01 to 100 m/s", np.abs(friction - exact).max(), 1e-12, "rounding")
    found = float(np.interp(1.0, speeds, friction))
    claims.near("f at 1 m/s", found, 0.2189, "printed digits", absolute=1e-4, against="literature")
    figure = style.figure(6.4, 3.2, layout="constrained")
    axes = figure.subplots()
    axes.semilogx(speeds, friction, color=style.LINES["blue"], label="15 °C")
    warm = parameter_sets.law("fault_gouge", temperature=465)
    cells = warm.cells(len(speeds), 1.0)
    cells.slip_rate[:] = speeds
    warm.prepare(1e-3)
    axes.semilogx(speeds, warm.strength(cells), color=style.LINES["orange"], label="465 °C")
    axes.set(xlabel="slip rate [m/s]", ylabel="friction", ylim=(0, 0.7))
    axes.legend(frameon=False)
    return Findings(claims, plots=[(figure, "Friction of contacts that heat, in a cool and in a warm zone.")])


@check("Calcite that decomposes", subject="Slip surfaces that heat", seconds=3)
def decomposition_caps(bench):
    """Heat of sliding at constant τ is taken up by the reaction once A exp(−Q/RT) ρ_m ΔH h = τ V: at the temperature
    T_c = Q/(R ln(A ρ_m ΔH h/(τ V))), for a reaction of order 0. That of order 1 rises on, by 3 K where 10 % have
    reacted.
    """
    claims = Claims()
    figure = style.figure(6.4, 3.4, layout="constrained")
    axes = figure.subplots()
    for speed, printed, colour in ((1.0, 753.6, "blue"), (10.0, 821.0, "orange")):
        cap = 319e3 / 8.31446 / math.log(2.95e15 * 2700 * 3.19e6 * 1e-3 / (1.5e6 * speed)) - 273.15
        claims.near(f"{speed:g} m/s: T_c [°C]", cap, printed, "printed digits", absolute=0.05, against="literature")
        for order in (0, 1):
            law = parameter_sets.law("calcite", friction=0.5, thermal_diffusivity=0, reaction_order=order)
            course = block.slide(law, block.Driven(speed, 3e6), 1e-3 / speed, block.Until(slip=3.0))
            k = int(np.argmax(course["reacted"] >= 0.1))
            why = "asked for: less is left to react" if order else "the step's heat, which is near nothing"
            what = f"{speed:g} m/s, order {order}: temperature at 10 % reacted [°C]"
            claims.near(what, course["temperature_degC"][k], cap, why, absolute=10 if order else 0.1)
            label = f"{speed:g} m/s, order {order}"
            axes.plot(
                course["slip_m"],
                course["temperature_degC"],
                color=style.LINES[colour],
                ls=":" if order else "-",
                label=label,
            )
    axes.set(xlabel="slip [m]", ylabel="temperature [°C]")
    axes.legend(frameon=False)
    return Findings(claims, plots=[(figure, "Temperature of a zone of 1 mm under a shear stress of 1.5 MPa.")])


@check("A layer of melt", subject="Slip surfaces that heat", seconds=3)
def melt_layer(bench):
    """A layer of the thickness m between walls at the melting point: K T'' + τ γ̇ = 0, τ = η₀ exp(−b (T − T_m)) γ̇. Its
    profile is known: τ = (η₀ V/m) s/(sinh s cosh s), s = asinh(V/W), W = √(8K/(b η₀)), and T rises by (2/b) ln cosh
    s. A boundary value solver that does not know it finds the same.
    """
    law, w = melting(), math.sqrt(8 * MELT["conductivity"] / (MELT["decay"] * MELT["viscosity"]))
    claims, rows = Claims(), []
    for ratio in (0.1, 1.0, 3.0) if bench.quick else (0.01, 0.1, 0.3, 1.0, 2.0, 3.0, 5.0):
        tau, rise = layer(ratio * w, **MELT)
        own, warm = law.melt_strength(ratio * w, MELT["thickness"], 1e12), law.melt_hottest(ratio * w) - 1100
        claims.near(
            f"V = {ratio:g} W: stress [MPa]",
            own / 1e6,
            tau / 1e6,
            "asked for",
            relative=0.01,
            against="boundary value solver",
        )
        claims.near(
            f"V = {ratio:g} W: rise in the middle [K]",
            warm,
            rise,
            "asked for",
            relative=0.01,
            against="boundary value solver",
        )
        rows.append((ratio, own / 1e6, tau / 1e6))
    own = law.melt_strength(w, 1e-4, 1e12) / 1e6
    claims.near("V = W: stress, as printed [MPa]", own, 1.763, "four digits", relative=3e-4, against="literature")
    claims.near(
        "V = W: rise, as printed [K]",
        law.melt_hottest(w) - 1100,
        34.66,
        "four digits",
        relative=3e-4,
        against="literature",
    )
    speeds = np.geomspace(0.01, 20, 100) * w
    figure = style.figure(6.4, 3.2, layout="constrained")
    axes = figure.subplots()
    axes.loglog(
        speeds / w, [law.melt_strength(v, 1e-4, 1e12) / 1e6 for v in speeds], color=style.LINES["blue"], label="the law"
    )
    axes.loglog(*np.array(rows).T[[0, 2]], "o", color=style.LINES["orange"], label="boundary value solver")
    axes.set(xlabel="V by W", ylabel="stress of 0.1 mm [MPa]")
    axes.legend(frameon=False)
    return Findings(claims, plots=[(figure, "Shear stress of a layer of melt.")])


@check("Melt from its beginning to its steady state", subject="Slip surfaces that heat", seconds=8, quick=3)
def melt_to_steady(bench):
    """Heat on a plane raises it by (τ V/ρc) √(t/(π α)), until it melts. Then dm/dt = τ V/(ρL') − σ m³/(C η R²), τ =
    F/m: integrated by another solver, and in the end τ = (ρL' σ/C)^(1/4) √(F/R), so that friction falls as σ^(−3/4)
    (Nielsen et al. 2008).
    """
    claims, speed = Claims(), 1.0
    s = math.asinh(speed / math.sqrt(8 * 2 / (0.02 * 100)))
    force = 100 * speed * s / (math.sinh(s) * math.cosh(s))
    for stress, known in ((0.9e6, 50.9), (1.44e6, 19.9)):
        step = 5e-3 if bench.quick else 1e-3
        course = block.slide(
            melting(friction=stress / 2e6), block.Driven(0.85, 2e6), step, block.Until(time=100, slip=1.1 * known)
        )
        slip = course["slip_m"][int(np.argmax(course["melt_m"] > 0))]
        claims.near(
            f"slip to melt at {stress / 1e6:g} MPa [m]", slip, known, "the first node is no plane", relative=0.01
        )
    ends, lines = [], []
    for sigma in (1e6, 4e6, 16e6):
        scale = (sigma / 1e6) ** -0.75  # of the time that it takes
        law, last = melting(friction=1.0, temperature=1090), block.Until(time=10 * scale)
        course = block.slide(law, block.Driven(speed, sigma), 1e-3 * scale, last)
        began = int(np.argmax(course["melt_m"] > 0))

        def grows(_, m, sigma=sigma):
            tau = min(sigma, force / m[0])
            return [tau * speed / 3.24e9 - sigma * m[0] ** 3 / (4 * force / speed * 0.01**2)]

        t = course["time_s"][began:] - course["time_s"][began]
        ode = solve_ivp(grows, (0, t[-1]), [course["melt_m"][began]], method="LSODA", rtol=1e-9, atol=1e-15, t_eval=t)
        exact = np.minimum(sigma, force / ode.y[0])
        own = course["strength_Pa"][began:]
        off = np.abs(own[2:] / exact[1:-1] - 1).max()  # a strength is that of the state before its step
        claims.at_most(
            f"{sigma / 1e6:g} MPa: largest error of the strength on the way",
            off,
            0.03,
            "a lag of a step",
            against="LSODA",
        )
        steady = (3.24e9 * sigma / 4) ** 0.25 * math.sqrt(force / 0.01)
        claims.near(
            f"{sigma / 1e6:g} MPa: strength in the end [MPa]", own[-1] / 1e6, steady / 1e6, "rounding", relative=1e-4
        )
        ends.append(own[-1] / sigma)
        lines.append((f"{sigma / 1e6:g} MPa", course))
    exponent = np.polyfit(np.log([1e6, 4e6, 16e6]), np.log(ends), 1)[0]
    claims.near("exponent of friction by stress", exponent, -0.75, "asked for is 3 %", relative=1e-3)
    brake = max(course["strength_Pa"][0] for _, course in lines[:1])
    claims.at_least(
        "first strength of melt by that in the end, 1 MPa", brake / (ends[0] * 1e6), 1.5, "a thin layer grips"
    )
    return Findings(
        claims, plots=[(sliding_block(lines), "Melt under three stresses, from just below its melting point.")]
    )


@check("Silica gel, and other tables", subject="Slip surfaces that heat", seconds=1)
def tabulated_friction(bench):
    """Friction that follows f_ss(V) within the slip L: after a jump to 0.1 m/s f(δ) = 0.2 + 0.4 exp(−δ/L) for silica
    gel (Di Toro et al. 2004). Tables of formulas are between their points what the formulas are.
    """
    claims = Claims()
    course = block.slide(
        parameter_sets.law("silica_gel"), block.Driven(0.1, 5e6), 1e-2, block.Until(slip=1.5, time=100)
    )
    friction = course["strength_Pa"] / 5e6
    slip = np.r_[0, course["slip_m"][:-1]]  # a strength is that of the slip before its step
    off = np.abs(friction - (0.2 + 0.4 * np.exp(-slip / 0.3))).max()
    claims.at_most("silica gel: largest error of f after a jump to 0.1 m/s", off, 1e-9, "exact in steps")
    claims.near(
        "silica gel: f after 0.3 m",
        np.interp(0.3, slip, friction),
        0.347,
        "printed digits",
        absolute=5e-4,
        against="literature",
    )
    speeds = np.geomspace(1e-3, 100, 3001)
    law = parameter_sets.law("lucas")
    cells = law.cells(len(speeds), 1.0)
    cells.slip_rate[:] = speeds
    law.prepare(1e-3)
    off = np.abs(law.strength(cells) - (0.11 + 0.73 / (1 + speeds / 4))).max()
    claims.at_most("1/(1 + V/V_w): largest error of f", off, 1e-3, "between 121 points")
    slow = block.slide(parameter_sets.law("slow_decay"), block.Driven(1.0, 1e6), 1e-2, block.Until(slip=100, time=1000))
    slip = np.r_[0, slow["slip_m"][:-1]]
    off = np.abs(slow["strength_Pa"] / 1e6 - 0.4 * (1 + slip / 0.15) ** (-1 / 3)).max()
    claims.at_most("(1 + δ/d_c)^(−1/3): largest error of f", off, 1e-3, "between 121 points")
    return Findings(
        claims, plots=[(sliding_block([("silica gel, 0.1 m/s", course)]), "Silica gel after a jump in speed.")]
    )


@check("The line where water boils", subject="Slip surfaces that heat", seconds=1)
def liquid_line(bench):
    """Equation (14), p_ev = 62 T exp(−4650/T) MPa, beside the formulation of IAPWS for industry (IF97), from which a
    fit of two numbers is off by some per cent. The paper's example: 100 m of rock press as vapour does at 220 °C.
    """
    claims = Claims(against="IAPWS-IF97")
    boils = laws.boiling_temperature(100 * 2500 * G)
    what = "temperature at the pressure of 100 m of rock [°C]"
    claims.near(what, boils, 220, "the paper has 220", absolute=1, against="literature")
    claims.near("the same [°C]", boils, 222.9, "a fit of two numbers", absolute=3.5)
    for degree, known in STEAM:
        found = laws.vapour_pressure(degree) / 1e6
        claims.near(f"vapour pressure at {degree} °C [MPa]", found, known, "a fit of two numbers", relative=0.25)
    degrees = np.linspace(60, 350, 291)
    figure = style.figure(6.4, 3.2, layout="constrained")
    axes = figure.subplots()
    axes.semilogy(degrees, [laws.vapour_pressure(t) / 1e6 for t in degrees], color=style.LINES["blue"], label="eq. 14")
    axes.semilogy(*zip(*STEAM), "o", color=style.LINES["orange"], label="IAPWS-IF97")
    axes.set(xlabel="temperature [°C]", ylabel="vapour pressure [MPa]")
    axes.legend(frameon=False)
    return Findings(claims, plots=[(figure, "Vapour pressure of water.")])
