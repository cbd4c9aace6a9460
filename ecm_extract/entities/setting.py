"""What a value in a file of parameters is called among provisions."""

from typing import Final

SETTING: Final = "parameter_setting"
