# Renders a leaning plane with an emitted filter that reads depth; the window's pixels come out as floats.
# Usage: scene_panda3d.py MODULE CLASS OUT WIDTH HEIGHT FOV NEAR FAR DISTANCE SLOPE RED GREEN BLUE

import importlib.util
import math
import sys

from panda3d.core import (
    CardMaker, FrameBufferProperties, GraphicsPipe, PerspectiveLens, Texture, WindowProperties, loadPrcFileData,
)


def main(module, name, out, width, height, *given):
    width, height = int(width), int(height)
    fov, near, far, distance, slope, red, green, blue = map(float, given)
    loadPrcFileData("", f"""
        load-display p3headlessgl
        window-type offscreen
        win-size {width} {height}
        audio-library-name null
        textures-power-2 none
        notify-level-glgsg warning
    """)
    from direct.showbase.ShowBase import ShowBase

    base = ShowBase()
    if base.win is None:
        sys.exit("Panda3D makes no window without a display")
    spec = importlib.util.spec_from_file_location("emitted", module)
    emitted = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(emitted)

    lens = PerspectiveLens()
    lens.setAspectRatio(width / height)
    lens.setMinFov(fov)
    lens.setNearFar(near, far)
    base.cam.node().setLens(lens)
    card = CardMaker("card")
    card.setFrame(-30, 30, -30, 30)
    card.setColor(red, green, blue, 1)
    shown = base.render.attachNewNode(card.generate())
    shown.setY(distance)
    # The upper part leans towards the viewer.
    shown.setP(math.degrees(slope))
    shown.setTwoSided(True)

    properties = FrameBufferProperties()
    properties.setFloatColor(True)
    properties.setRgbaBits(32, 32, 32, 32)
    properties.setDepthBits(24)
    window = base.graphicsEngine.makeOutput(
        base.pipe, "window", 0, properties, WindowProperties.size(width, height), GraphicsPipe.BF_refuse_window, base.win.getGsg(), base.win)
    window.makeDisplayRegion().setCamera(base.cam)
    base.win.setActive(False)
    getattr(emitted, name)(window, base.cam, fbprops=properties)

    read = Texture("read")
    window.addRenderTexture(read, window.RTMCopyRam)
    base.graphicsEngine.renderFrame()
    base.graphicsEngine.renderFrame()
    with open(out, "wb") as file:
        file.write(bytes(read.getRamImageAs("RGBA")))


main(*sys.argv[1:])
