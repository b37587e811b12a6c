"""Changes that compute the same for every input, or what nobody can be asked to test: the generators leave them out.

{(file, what stands there, what takes its place): reason}, both texts as the table of `random_mutants.py` shows them.
"""

STYLE = "py/nonsmooth/figures/style.py"

SAME = {
    (
        STYLE,
        'def draw_disks(ax, snapshot, colours, mask=slice(None), edge="none", width=0.0, zorder=2):',
        'def draw_disks(ax, snapshot, colours, mask=slice(None), edge="none", width=1.0, zorder=2):',
    ): "an edge of no colour is not drawn, however wide; who gives a colour gives a width",
    (
        "py/nonsmooth/comparison/cases.py",
        "HARD_NUMERICS = ((2.0, 10.0), (2.0, 1.0), (1.0, 10.0), (0.5, 0.5))",
        "HARD_NUMERICS = ((2.0, 10.0), (2.0, 1.0), (1.0, 20.0), (0.5, 0.5))",
    ): "a choice: any coarser numerics can be compared with the last, and its rows say which they are",
    (
        "py/nonsmooth/comparison/precision.py",
        "float(np.corrcoef(a, b)[0, 1]) if a.std() > 0 and b.std() > 0 else math.nan,",
        "float(np.corrcoef(a, b)[0, 1]) if True and b.std() > 0 else math.nan,",
    ): "NaN either way, with a warning of NumPy's besides",
    (
        "py/nonsmooth/statistics.py",
        "return float(np.std(values, ddof=1) / math.sqrt(len(values))) if len(values) > 1 else math.nan",
        "return float(np.std(values, ddof=1) / math.sqrt(len(values))) if len(values) >= 1 else math.nan",
    ): "NaN either way, with a warning of NumPy's besides",
    (
        "py/nonsmooth/section_units.py",
        "return isinstance(value, (int, float)) and not isinstance(value, bool)",
        "return True and not isinstance(value, bool)",
    ): "what else a checked material holds, words, stands under no key that has bounds",
    ("py/nonsmooth/figures/sweep.py", "if handles:", "if True:"): "a legend without entries and frame shows nothing",
}
