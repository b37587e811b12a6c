"""From model and packing to a YADE scene, of rigid or soft contacts, and what is read from it. This room imports
YADE.
"""
