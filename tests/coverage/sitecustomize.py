"""Starts coverage.py in every Python, also the one inside YADE and those that tests start, where COVERAGE_PROCESS_START names its settings."""
import coverage

coverage.process_startup()
