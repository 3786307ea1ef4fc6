"""Draws one frame of a run of Seiche with ParaView 5.11: the liquid's surface coloured by speed, and the solids.

    seiche export RUN --format xdmf
    xvfb-run -a -s -noreset pvbatch share/paraview/show_run.py RUN/export/NAME.xdmf picture.png [--frame 12]

Debian's pvbatch needs a display; xvfb-run makes one. In 3D the surface is the contour 0 of `surface_at_nodes`, in 2D
what lies below 0."""
import argparse
import os
import pathlib
import sys

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parent.parent / "common")]

from paraview import simple as pv  # noqa: E402

from seiche_run import RunFault, end_with  # noqa: E402

BACKGROUND, SOLID_COLOR = [0.95, 0.96, 0.97], [0.85, 0.72, 0.55]
RAMP = ((0.0, (0.02, 0.16, 0.36)), (0.35, (0.05, 0.42, 0.66)), (0.7, (0.35, 0.74, 0.86)), (1.0, (0.96, 0.99, 1.0)))


def options_of(arguments):
    """Options of the command line."""
    parser = argparse.ArgumentParser(prog="show_run.py", description="Draws one frame of a run of Seiche.")
    parser.add_argument("xdmf", help="file of `seiche export --format xdmf`")
    parser.add_argument("picture", help="PNG to write")
    parser.add_argument("--frame", type=int, help="which of the file's frames, from 0; default: the last one")
    parser.add_argument("--field", default="velocity", help="field to colour by; of vectors their length")
    parser.add_argument("--up", default="y", choices=("y", "z"), help="axis that points up in the scene")
    parser.add_argument("--size", default="960x540", help="width and height of the picture")
    return parser.parse_args(arguments)


def open_run(path, frame):
    """Reader of the file at one of its times."""
    if not pathlib.Path(path).is_file():
        raise RunFault(f"{path}: there is no such file; seiche export RUN --format xdmf writes it")
    reader = pv.XDMFReader(FileNames=[str(path)])
    reader.UpdatePipelineInformation()
    times = list(reader.TimestepValues)
    number = len(times) - 1 if frame is None else frame
    if not 0 <= number < len(times):
        raise RunFault(f"--frame: there is no frame {frame}; the file has 0 to {len(times) - 1}")
    reader.UpdatePipeline(times[number])
    return reader, times[number]


def part(reader, name):
    """One grid of the file, fluid or solids, at the reader's time; none if the run has no such part."""
    data = reader.GetClientSideObject().GetOutputDataObject(0)
    for n in range(data.GetNumberOfBlocks()):
        if data.GetMetaData(n).Get(data.NAME()).split("[")[0] == name:
            source = pv.TrivialProducer()
            source.GetClientSideObject().SetOutput(data.GetBlock(n))
            source.UpdatePipeline()
            return source
    return None


def liquid_surface(fluid, is_flat):
    """What to draw of the liquid."""
    if is_flat:
        surface = pv.Clip(Input=fluid, ClipType="Scalar", Scalars=["POINTS", "surface_at_nodes"], Value=0.0, Invert=1)
    else:
        surface = pv.Contour(Input=fluid, ContourBy=["POINTS", "surface_at_nodes"], Isosurfaces=[0.0],
                             ComputeNormals=1)
    surface.UpdatePipeline()
    return surface


def color_by(surface, view, field):
    """Draws a surface in the colours of a field, with a bar."""
    name = field + "_at_nodes"
    array = surface.PointData.GetArray(name)
    if array is None:
        raise RunFault(f"--field: there is no field '{field}' at nodes")
    is_vector = array.GetNumberOfComponents() > 1
    shown = pv.Show(surface, view)
    pv.ColorBy(shown, ("POINTS", name, "Magnitude") if is_vector else ("POINTS", name))
    shown.Specular, shown.SpecularPower = 0.4, 40
    low, high = (0.0, array.GetRange(-1)[1]) if is_vector else array.GetRange(0)
    high = high if high > low else low + 1
    table = pv.GetColorTransferFunction(name)
    table.RGBPoints = [x for at, color in RAMP for x in (low + at * (high - low), *color)]
    table.ColorSpace = "Lab"
    bar = pv.GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = ("speed, m/s" if field == "velocity" else field), ""
    bar.TitleColor = bar.LabelColor = [0.1, 0.1, 0.1]
    bar.TitleFontSize = bar.LabelFontSize = 13
    bar.LabelFormat = bar.RangeLabelFormat = "%.3g"
    bar.ScalarBarLength, bar.WindowLocation = 0.35, "Upper Right Corner"
    shown.SetScalarBarVisibility(view, True)


def add_outline(fluid, view):
    """Edges of the domain."""
    shown = pv.Show(pv.Outline(Input=fluid), view)
    shown.AmbientColor = shown.DiffuseColor = [0.45, 0.45, 0.48]


def add_solids(solids, view, is_flat):
    """Surfaces of the solids in one colour; lines in 2D."""
    if not is_flat:
        solids = pv.GenerateSurfaceNormals(Input=pv.ExtractSurface(Input=solids), FeatureAngle=35)
    shown = pv.Show(solids, view)
    shown.ColorArrayName = ["POINTS", ""]
    shown.AmbientColor = shown.DiffuseColor = SOLID_COLOR if not is_flat else [0.15, 0.13, 0.12]
    shown.LineWidth = 3


def place_camera(view, bounds, up, is_flat):
    """Looks at the domain from the front, in 3D a little from the left and above."""
    center = [0.5 * (bounds[2 * a] + bounds[2 * a + 1]) for a in range(3)]
    ahead = (0, 0, -1) if is_flat else ((0.42, -0.42, -1.0) if up == "y" else (0.42, 1.0, -0.42))
    view.CameraFocalPoint = center
    view.CameraPosition = [c - a for c, a in zip(center, ahead)]
    view.CameraViewUp = [0, 1, 0] if up == "y" else [0, 0, 1]
    view.CameraParallelProjection = int(is_flat)
    view.CameraViewAngle = 25
    view.ResetCamera(*bounds)
    pv.GetActiveCamera().Zoom(1.3)


def make_view(size):
    """An empty view of this size."""
    try:
        width, height = (int(n) for n in size.split("x"))
    except ValueError as fault:
        raise RunFault(f"--size: '{size}' is no size; give for example 960x540") from fault
    view = pv.CreateRenderView()
    view.ViewSize, view.OrientationAxesVisibility = [width, height], 0
    view.UseColorPaletteForBackground = 0
    view.Background = BACKGROUND
    return view


def check_display():
    """Ends with advice where pvbatch would abort."""
    if sys.platform == "linux" and not os.environ.get("DISPLAY") and not os.environ.get("SEICHE_NO_DISPLAY"):
        raise RunFault("there is no display; run `xvfb-run -a -s -noreset pvbatch ...` (packages xvfb and xauth). Where "
                       "pvbatch is built to draw without one, set SEICHE_NO_DISPLAY=1")


def draw(options):
    """Draws the picture and prints the bounds of the liquid."""
    check_display()
    reader, time = open_run(options.xdmf, options.frame)
    fluid, solids = part(reader, "fluid"), part(reader, "solids")
    if fluid is None:
        raise RunFault(f"{options.xdmf}: has no grid 'fluid'; is it of seiche export?")
    bounds = fluid.GetDataInformation().GetBounds()
    is_flat = bounds[4] == bounds[5]
    view = make_view(options.size)
    surface = liquid_surface(fluid, is_flat)
    if surface.GetDataInformation().GetNumberOfPoints() > 0:
        color_by(surface, view, options.field)
    add_outline(fluid, view)
    if solids is not None:
        add_solids(solids, view, is_flat)
    pv.Render(view)  # the first one places the camera itself
    place_camera(view, bounds, options.up, is_flat)
    pv.Render(view)
    pv.SaveScreenshot(options.picture, view)
    print(f"t = {time:g} s, bounds of the liquid", *surface.GetDataInformation().GetBounds(), flush=True)


if __name__ == "__main__":
    try:
        draw(options_of(sys.argv[1:]))
    except RunFault as fault:
        end_with(fault)
