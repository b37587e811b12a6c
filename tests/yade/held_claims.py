"""What a test says of the claims of a check that do not hold."""


def failed(claims):
    """Those that do not, a line each; nothing where all do."""
    return "\n".join(
        f"{c.what}: {c.measured:.9g} {c.unit}, allowed {c.low:.9g} to {c.high:.9g}" for c in claims if not c.passed
    )
