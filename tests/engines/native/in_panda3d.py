# Runs an emitted module as its README says, without a display: the picture is a card before the camera, drawn by the engine; other
# textures are given as floats, rows from below; the window's pixels come out so.
# Usage: in_panda3d.py MODULE CLASS WIDTH HEIGHT OUT [NAME=FILE,FILE... | uniform:NAME=VALUE]...; `color` is the picture.

import importlib.util
import sys

from panda3d.core import (
    CardMaker, FrameBufferProperties, GraphicsPipe, OrthographicLens, SamplerState, Texture, WindowProperties, loadPrcFileData,
)


def texture(name, width, height, files):
    made = Texture(name)
    if len(files) > 1:
        made.setup2dTextureArray(width, height, len(files), Texture.T_float, Texture.F_rgba32)
    else:
        made.setup2dTexture(width, height, Texture.T_float, Texture.F_rgba32)
    made.setMinfilter(SamplerState.FT_nearest)
    made.setMagfilter(SamplerState.FT_nearest)
    # Panda3D keeps blue before red.
    made.setRamImageAs(b"".join(open(file, "rb").read() for file in files), "RGBA")
    return made


def main(module, name, width, height, out, *given):
    width, height = int(width), int(height)
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

    inputs = dict(one.split("=", 1) for one in given)
    textures = {key: value.split(",") for key, value in inputs.items() if not key.startswith("uniform:")}
    uniforms = {key[8:]: float(value) for key, value in inputs.items() if key.startswith("uniform:")}

    lens = OrthographicLens()
    lens.setFilmSize(width, height)
    base.cam.node().setLens(lens)
    card = CardMaker("card")
    card.setFrame(-width / 2, width / 2, -height / 2, height / 2)
    shown = base.render.attachNewNode(card.generate())
    shown.setY(5)
    shown.setTexture(texture("card", width, height, textures.pop("color")))

    # What has no display has no window of floats: a buffer takes its place.
    properties = FrameBufferProperties()
    properties.setFloatColor(True)
    properties.setRgbaBits(32, 32, 32, 32)
    window = base.graphicsEngine.makeOutput(
        base.pipe, "window", 0, properties, WindowProperties.size(width, height), GraphicsPipe.BF_refuse_window, base.win.getGsg(), base.win)
    window.makeDisplayRegion().setCamera(base.cam)
    base.win.setActive(False)
    made = getattr(emitted, name)(window, base.cam, fbprops=properties)
    made.set(**uniforms)
    for key, files in textures.items():
        made.set(**{key: texture(key, width, height, files)})

    read = Texture("read")
    window.addRenderTexture(read, window.RTMCopyRam)
    base.graphicsEngine.renderFrame()
    base.graphicsEngine.renderFrame()
    if (read.getXSize(), read.getYSize(), read.getComponentWidth()) != (width, height, 4):
        sys.exit(f"the picture is {read}")
    with open(out, "wb") as file:
        file.write(bytes(read.getRamImageAs("RGBA")))


main(*sys.argv[1:])
