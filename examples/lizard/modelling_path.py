"""Importing this makes examples/modelling importable, wherever the script was started from."""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "modelling"))
