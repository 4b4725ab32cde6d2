"""Puts compiled kernels into a wheel when it is told where they are; see ``compiled_wheel.py``."""

from __future__ import annotations

import os
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class CompiledKernels(BuildHookInterface):
    """With VIASPLINE_COMPILED a wheel holds that folder, and is one for this Python and system."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Add the folder, if there is one."""
        folder = os.environ.get("VIASPLINE_COMPILED")
        if folder and self.target_name == "wheel" and version == "standard":
            build_data["force_include"][folder] = "viaspline/kernels/compiled"
            build_data["pure_python"] = False
            build_data["infer_tag"] = True
