"""Open3D, with the libusb that its shared object needs; the one place that imports it.

Open3D's wheel is linked with libusb-1.0.so.0, for cameras that are not used here, and
does not carry it. libusb-package does. Once a library is loaded the linker looks for no
other of its name, so it makes no difference whether the system has one.

In a notebook Open3D would start a web server for its own windows, and say so; nothing
here opens one, so it does only where the environment asks for it.
"""

import ctypes
import os
import sys

if sys.platform == "linux":
    import libusb_package

    ctypes.CDLL(str(libusb_package.get_library_path()), mode=ctypes.RTLD_GLOBAL)

os.environ.setdefault("OPEN3D_DISABLE_WEB_VISUALIZER", "true")

import open3d

__all__ = ["open3d"]
