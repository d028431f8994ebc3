"""Text files that people give: measured spectra, lamps, schedules."""
