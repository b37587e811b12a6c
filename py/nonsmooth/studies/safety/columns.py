"""Columns of the series.csv of a search for the factor of safety. Needs no YADE."""

from ...records.columns import BONDS, STEP, Column, count, declared

__all__ = ["COLUMNS"]

#: {name: Column}; a row for each row of a slope's run, of all trials one after another.
COLUMNS = declared(
    STEP,
    Column("time_s", "s", "simulated time of all trials until here"),
    count("trial", "number of the trial, from 1; 0 are loadings, which have series of their own"),
    Column("factor", "1", "number by which strengths are divided"),
    Column("water_m", "m", "height of the water table above its plane; 0 under a field of water"),
    Column("speed_mean_m_per_s", "m/s", "mean speed of the disks of the mass"),
    Column("speed_max_m_per_s", "m/s", "largest speed of a disk"),
    Column("displacement_mean_m", "m", "mean displacement of the disks of the mass from where they rested at first"),
    Column("displacement_max_m", "m", "largest displacement of one of them"),
    *BONDS,
    count("contacts", "contacts, bonded ones included"),
)
