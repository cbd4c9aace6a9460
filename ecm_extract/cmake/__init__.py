"""CMake files run without CMake: which targets, sources and installs a build has, and what of it is not known."""

from ecm_extract.cmake.evaluator import evaluate
from ecm_extract.cmake.files import BuildFiles
from ecm_extract.cmake.package import stated

__all__ = ["BuildFiles", "evaluate", "stated"]
