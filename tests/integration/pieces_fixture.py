"""Surfaces and grids in pieces, as a run of many capsules or in a large box writes them."""

import meshio
from vtkmodules.vtkImagingCore import vtkExtractVOI
from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLImageDataWriter

INDEX = """<VTKFile type="{kind}" version="1.0" byte_order="LittleEndian">
<{kind} GhostLevel="0"{frame}>
{arrays}
{pieces}
</{kind}>
</VTKFile>
"""


def _arrays(element, arrays):
    rows = (f'<PDataArray type="Float64" Name="{name}" NumberOfComponents="{n}"/>' for name, n in arrays.items())
    return f"<{element}>{''.join(rows)}</{element}>"


def _components(arrays):
    return {name: 1 if values.ndim == 1 else values.shape[1] for name, values in arrays.items()}


def write_surface_in_pieces(index, meshes):
    """A .pvtu of these meshio.Mesh, each of one block, in the files NAME/0.vtu, NAME/1.vtu ..."""
    folder = index.with_suffix("")
    folder.mkdir(exist_ok=True)
    for k, mesh in enumerate(meshes):
        meshio.write(folder / f"{k}.vtu", mesh)
    arrays = [
        _arrays("PPoints", {"Points": 3}),
        _arrays("PPointData", _components(meshes[0].point_data)),
        _arrays("PCellData", _components({name: blocks[0] for name, blocks in meshes[0].cell_data.items()})),
    ]
    pieces = "\n".join(f'<Piece Source="{folder.name}/{k}.vtu"/>' for k in range(len(meshes)))
    index.write_text(INDEX.format(kind="PUnstructuredGrid", frame="", arrays="\n".join(arrays), pieces=pieces))


def cut_grid(file, layer):
    """A .pvti beside a .vti, of two pieces that share that layer of nodes along z; the .vti goes."""
    reader = vtkXMLImageDataReader()
    reader.SetFileName(str(file))
    reader.Update()
    grid, folder = reader.GetOutput(), file.with_suffix("")
    folder.mkdir()
    extent, rows = list(grid.GetExtent()), []
    for k, part in enumerate((extent[:4] + [extent[4], layer], extent[:4] + [layer, extent[5]])):
        cutter, writer = vtkExtractVOI(), vtkXMLImageDataWriter()
        cutter.SetInputData(grid)
        cutter.SetVOI(*part)
        writer.SetInputConnection(cutter.GetOutputPort())
        writer.SetFileName(str(folder / f"{k}.vti"))
        writer.Write()
        rows.append(f'<Piece Extent="{" ".join(map(str, part))}" Source="{folder.name}/{k}.vti"/>')
    frame = f' WholeExtent="{" ".join(map(str, extent))}" Origin="0.5 0.5 0.5" Spacing="1 1 1"'
    arrays = {grid.GetPointData().GetArrayName(k): grid.GetPointData().GetArray(k).GetNumberOfComponents() for k in range(grid.GetPointData().GetNumberOfArrays())}
    file.with_suffix(".pvti").write_text(INDEX.format(kind="PImageData", frame=frame, arrays=_arrays("PPointData", arrays), pieces="\n".join(rows)))
    file.unlink()
