# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""`python -m meniscus` is the command `meniscus`."""
import sys

from .viewer.command import program

sys.exit(program())
