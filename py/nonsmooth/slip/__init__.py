"""How a slip surface loses its strength: the library's laws (``pkg/contact/slip``), named sets of their parameters,
and a sliding block that tries them in seconds. Needs no YADE, but this project's module ``_nonsmooth_slip``::

    from nonsmooth.slip import block, laws, parameter_sets
    law = parameter_sets.law("vaiont")
    course = block.slide(law, block.OnSlope(22, 100, 2400, speed=0.1), step=5e-3, until=block.Until(share=0.1))
    print(course["slip_m"][-1], course["temperature_degC"][-1])
"""

__all__ = ["block", "cell_places", "laws", "parameter_sets", "surface"]
