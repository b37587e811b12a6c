"""Spheres at rest in their container, with hard contacts; made once and kept, so that both worlds begin with the same
places.
"""

from __future__ import annotations

import math

import numpy as np

from yade import O

from ...system import cache, keys
from ...world import sphere_worlds as worlds
from ...world.stepping import until
from . import scene as scenes
from .grains import SpheresError
from .places import Places

__all__ = ["CACHE", "cache_path", "height_of", "prepared"]

CACHE = cache.Cache("heaps", Places)
PATH = 0.1  # mean diameters a step, at the speed of the fall
TOLERANCE = 1e-4
REST_SPEED = 0.01  # √(g d), rms
LIMIT = 40_000  # steps
CHUNK = 50
#: Parameters that do not matter to the spheres before the release.
LATER = ("restitution", "opening", "froude", "turns")


def cache_path(scene):
    """Where the prepared spheres of a SphereScene are kept: by its parameters, engines and code."""
    plain = {key: value for key, value in scene.plain().items() if key not in LATER}
    return CACHE.path(keys.key_of([plain, keys.making_key(__name__)]))


def prepared(scene):
    """The Places of a SphereScene's spheres at rest in its container, from the cache or made in the running scene,
    which is emptied.

    They fall from a loose lattice, with the scene's friction and without restitution. Raises SpheresError where they do
    not fit or do not come to rest.
    """
    return CACHE.of(cache_path(scene), lambda: _settle(scene))


def _settle(scene):
    r = scene.radii()
    at = scene.sites(r)
    order = np.lexsort(at.T[[1, 0, 2]])  # neighbours in space are neighbours in memory
    at = at[order]
    top = float(np.max(at[:, 2])) + 2 * float(np.max(r))
    drop = max(top - float(np.min(at[:, 2])) - scene.depth(), 4 * scene.diameter)
    step = PATH * scene.diameter / math.sqrt(2 * scene.gravity * drop)
    bodies = scenes.put(scene, worlds.HardSpheres(step, TOLERANCE), at, r, top, still=True)
    wanted = REST_SPEED * math.sqrt(scene.gravity * scene.diameter)

    def speed():
        return math.sqrt(np.mean(scenes.places(bodies).speed ** 2))

    if not until(lambda: speed() <= wanted, LIMIT, CHUNK):
        raise SpheresError(
            f"the spheres do not come to rest in their container: rms speed {speed():.2g} m/s after {O.iter} steps, wanted {wanted:.2g} m/s; try another seed"
        )
    found = scenes.places(bodies)
    O.reset()
    return Places(**{**vars(found), "speed": np.zeros(len(found))})


def height_of(scene, places):
    """Height [m] of what lies in a standing cylinder, whose bottom is at z = 0: twice that of its centre of mass. Of a
    drum its radius.
    """
    if scene.KIND == "drum":
        return scene.radius
    weight = places.r**3
    return 2 * float(np.sum(weight * places.at[:, 2]) / np.sum(weight))
