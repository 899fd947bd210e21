"""Adds examples/modelling to Python's path, so that scripts started in any folder can import it."""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "modelling"))
