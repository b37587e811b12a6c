"""Laws of slip surfaces by name, and cells that they act on. What each law says stands in ``pkg/contact/slip``."""

from __future__ import annotations

import numbers
from dataclasses import dataclass

from ..errors import UserError
from ..system import installation

__all__ = ["Parameter", "SlipError", "SlipLaw", "boiling_temperature", "known", "parameters", "vapour_pressure"]


class SlipError(UserError, ValueError):
    """A law, its parameters or a block that make no sense; one message says which, and what would do."""


@dataclass(frozen=True)
class Parameter:
    """What a law is to be given: ``fallback`` is None where it must be; ``many``: a list of numbers."""

    key: str
    unit: str  # "-" for none
    what: str
    required: bool
    fallback: float | None
    many: bool


def _library():
    try:
        return installation.module("_nonsmooth_slip")
    except installation.InstallationError:
        raise SlipError(
            "the laws of slip surfaces are not built; run scripts/setup.sh, and have build/python on the PYTHONPATH"
        ) from None


def known():
    """The laws' names, and each in a few words: {name: words}. Raises SlipError where the library is not built."""
    return {law["name"]: law["what"] for law in _library().laws()}


def _parameters(described):
    names = ("key", "unit", "what", "required", "fallback")
    return [Parameter(*(one[name] for name in names), many=one["list"]) for one in described]


def parameters(*names):
    """The :class:`Parameter` list of a law, or of several that share a zone, each key once.

    Raises SlipError for an unknown name.
    """
    by_name = {law["name"]: law for law in _library().laws()}
    found = {}
    for name in names:
        if name not in by_name:
            raise SlipError(f"slip law {name!r}: it must be one of {', '.join(by_name)}")
        shared = _library().zone_parameters() if by_name[name]["heats"] else []
        found |= {one.key: one for one in _parameters([*by_name[name]["parameters"], *shared])}
    return list(found.values())


def _plain(law, key, value):
    values = [value] if isinstance(value, numbers.Real) else value
    if isinstance(value, (str, bool)) or not hasattr(values, "__iter__"):
        raise SlipError(f"slip law {law}: {key} = {value!r}: give a number, or a list where the law takes one")
    values = list(values)
    for one in values:
        if not isinstance(one, numbers.Real) or isinstance(one, bool):
            raise SlipError(f"slip law {law}: {key} holds {one!r}: give numbers")
    return [float(one) for one in values]


class SlipLaw:
    """A law, or several that share a heated zone, with its parameters.

    ``names``: one name or a list; ``values``: numbers, or lists of numbers, by key (see :func:`parameters`). A step of
    the length h [s] is ``prepare(h)``, ``strength(cells)``, what happens in it, ``advance(cells)``. Raises SlipError
    for what is missing, unknown or out of range.
    """

    def __init__(self, names, **values):
        self.names = (names,) if isinstance(names, str) else tuple(names)
        self.values = dict(values)
        together = "+".join(map(str, self.names))
        plain = {key: _plain(together, key, value) for key, value in values.items()}
        try:
            self._law = _library().Law([str(name) for name in self.names], plain)
        except ValueError as error:
            raise SlipError(str(error)) from None
        self._asked = False

    def __repr__(self):
        return f"SlipLaw({'+'.join(self.names)})"

    @property
    def heats(self):
        """Whether it has a zone that heats, with temperatures across it."""
        return self._law.heats

    def friction(self):
        """Friction [-] before slip."""
        return self._law.friction()

    def cells(self, count=1, normal_stress=0.0):
        """``count`` cells under a stress [Pa] that have not slipped.

        Arrays (count,) that share the library's memory: given are ``normal_stress`` [Pa] and ``slip_rate`` [m/s] before
        a step, ``path`` [m] and ``heat`` [J/m²] after it; found are ``strength`` [Pa] and ``slip`` [m].
        ``columns``: the law's own by name, (count,) or (count, nodes), in ``units``.
        """
        return self._law.cells(count, normal_stress)

    def prepare(self, h):
        """Takes up the length of the steps to come [s]. Raises SlipError where it is not positive."""
        try:
            self._law.prepare(h)
        except ValueError as error:
            raise SlipError(str(error)) from None

    def strength(self, cells):
        """The cells' strengths [Pa] for the step to come: their array."""
        self._law.strength(cells)
        self._asked = True
        return cells.strength

    def advance(self, cells):
        """Takes up the step that was made. Raises SlipError where its strength was not asked for."""
        if not self._asked:
            raise SlipError("advance() without strength(): ask for the strength of a step first")
        self._asked = False
        self._law.advance(cells)

    def places(self):
        """Distances [m] of the nodes of a profile from the middle of the zone, (nodes,)."""
        return self._law.places()

    def zone_mean(self, profiles):
        """Mean over the zone of profiles (cells, nodes): (cells,)."""
        return self._law.zone_mean(profiles)

    def heat_in(self, cells):
        """Heat [J/m²] that cells hold over that of their beginning, (cells,)."""
        return self._law.heat_in(cells)

    def flash_velocity(self, temperature):
        """V_w [m/s] at a temperature [°C], eq. (15); of a law with flash heating."""
        return self._law.flash_velocity(temperature)

    def melt_strength(self, speed, thickness, normal_stress):
        """Strength [Pa] of a layer of melt [m] at a speed [m/s]; of a law with shear melting."""
        return self._law.melt_strength(speed, thickness, normal_stress)

    def melt_viscosity(self, speed):
        """Viscosity [Pa s] of a layer of melt as a whole at a speed [m/s]; of a law with shear melting."""
        return self._law.melt_viscosity(speed)

    def melt_hottest(self, speed):
        """Temperature [°C] in the middle of a layer of melt at a speed [m/s]; of a law with shear melting."""
        return self._law.melt_hottest(speed)


def vapour_pressure(temperature):
    """Pressure [Pa] at which water of a temperature [°C] turns to vapour, the paper's eq. (14)."""
    return _library().vapour_pressure(temperature)


def boiling_temperature(pressure):
    """Temperature [°C] at which water of an absolute pressure [Pa] turns to vapour, the same line."""
    return _library().boiling_temperature(pressure)
