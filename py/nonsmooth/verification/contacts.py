"""One disk against walls: sliding, rolling, spinning, driven walls."""
