# SPDX-License-Identifier: GPL-2.0-or-later
"""As the campaign."""
from campaign import costs, figures, numbers, pages, table
