"""The tables of doc/theory/stepping.rst say what a contact is made of as the code has it."""

import re
from pathlib import Path

import pytest
from yade.wrapper import ContactDynamicsEngine

PAGE = Path(__file__).resolve().parents[3] / "doc" / "theory" / "stepping.rst"


def tables():
    """Rows of the two tables of forms and passes, as lists of cells."""
    section = PAGE.read_text().partition(".. _contact-forms:")[2].partition("The size of a step")[0]
    found = []
    for table in section.split(".. list-table::")[1:]:
        rows = re.split(r"^   \* - ", table, flags=re.M)[1:]
        found.append([[cell.strip() for cell in re.split(r"^     - ", row, flags=re.M)] for row in rows][1:])
    return found


def test_the_forms_have_the_bytes_of_the_page():
    forms, _ = tables()
    assert {row[0]: int(row[2].split()[0]) for row in forms} == ContactDynamicsEngine.contactForms()


@pytest.mark.parametrize("cells, column", [(1, 3), (2, 4)], ids=["read", "written"])
def test_a_pass_reads_and_writes_the_bytes_of_its_forms(cells, column):
    of = ContactDynamicsEngine.contactForms()
    passes = tables()[1]
    assert len(passes) > 10
    for row in passes:
        forms = [] if row[cells] == "—" else [form.strip() for form in row[cells].split(",")]
        assert sum(of[form] for form in forms) == int(row[column].split()[0]), row[0]
