# SPDX-License-Identifier: BSD-3-Clause
"""The picture on the whole screen of an X server, by its own library."""
import ctypes
import ctypes.util

from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkCommonCore import VTK_UNSIGNED_CHAR
from vtkmodules.vtkIOImage import vtkPNGWriter


class XImage(ctypes.Structure):
    """The head of Xlib's own."""
    _fields_ = [("width", ctypes.c_int), ("height", ctypes.c_int), ("xoffset", ctypes.c_int),
                ("format", ctypes.c_int), ("data", ctypes.POINTER(ctypes.c_ubyte)), ("byte_order", ctypes.c_int),
                ("bitmap_unit", ctypes.c_int), ("bitmap_bit_order", ctypes.c_int), ("bitmap_pad", ctypes.c_int),
                ("depth", ctypes.c_int), ("bytes_per_line", ctypes.c_int), ("bits_per_pixel", ctypes.c_int)]


def grab_screen(width, height, file_name):
    """Writes the left upper part of the screen as a .png file."""
    x11 = ctypes.CDLL("libX11.so.6")
    x11.XOpenDisplay.restype = x11.XDefaultRootWindow.restype = ctypes.c_void_p
    x11.XDefaultRootWindow.argtypes = [ctypes.c_void_p]
    x11.XGetImage.restype = ctypes.POINTER(XImage)
    x11.XGetImage.argtypes = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int, ctypes.c_int, ctypes.c_uint,
                              ctypes.c_uint, ctypes.c_ulong, ctypes.c_int]
    display = x11.XOpenDisplay(None)
    every_plane, whole_pixels = 2**32 - 1, 2
    grabbed = x11.XGetImage(display, x11.XDefaultRootWindow(display), 0, 0, width, height, every_plane,
                            whole_pixels).contents
    rows = ctypes.string_at(grabbed.data, grabbed.bytes_per_line * height)
    image = vtkImageData()
    image.SetDimensions(width, height, 1)
    image.AllocateScalars(VTK_UNSIGNED_CHAR, 3)
    pixels = memoryview(image.GetPointData().GetScalars()).cast("B")
    for row in range(height):
        line = rows[row * grabbed.bytes_per_line:row * grabbed.bytes_per_line + 4 * width]
        start = 3 * width * (height - 1 - row)
        for channel in range(3):  # stored as blue, green, red
            pixels[start + channel:start + 3 * width:3] = line[2 - channel::4]
    writer = vtkPNGWriter()
    writer.SetInputData(image)
    writer.SetFileName(file_name)
    writer.Write()
