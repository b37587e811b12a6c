"""Every attribute of a scene, to be compared bit by bit."""
from contact_scenes import engine
from yade import O


def plain(value):
    """A value that compares bit by bit; what is an object is compared by its own attributes."""
    if hasattr(value, "dict"):
        return value.__class__.__name__, tuple(sorted((k, plain(v)) for k, v in value.dict().items()))
    if isinstance(value, (list, tuple)):
        return tuple(plain(v) for v in value)
    return repr(value)


def everything():
    """Every attribute of bodies, interactions and forces, in the order in which YADE lists them; and the counters and
    sums of the solver.
    """
    bodies = [(b.id, plain(b.state)) for b in O.bodies if b]
    links = [
        (i.id1, i.id2, i.isReal, i.iterBorn, i.iterMadeReal, i.geom and plain(i.geom), i.phys and plain(i.phys))
        for i in O.interactions
    ]
    forces = [(plain(O.forces.f(b.id)), plain(O.forces.t(b.id))) for b in O.bodies if b]
    own = {
        k: plain(v)
        for k, v in engine().dict().items()
        if "econds" not in k and not k.startswith("view") and k not in ("label", "ompThreads")
    }
    return bodies, links, forces, own, O.iter, O.time
