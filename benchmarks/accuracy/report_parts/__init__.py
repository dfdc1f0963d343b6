# SPDX-License-Identifier: GPL-3.0-or-later
"""The parts of `report`: tables in, document and plots out."""
