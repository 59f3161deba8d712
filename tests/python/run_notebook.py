"""usage: run_notebook.py NOTEBOOK.ipynb

Runs every cell; each that ends in a figure must have shown one. Outputs are thrown away: the file is not changed.
"""

import sys

import nbclient
import nbformat


def main(path):
    notebook = nbformat.read(path, as_version=4)
    for cell in notebook.cells:
        assert not cell.get("outputs"), "the notebook is kept without outputs"
    nbclient.NotebookClient(notebook, timeout=600, kernel_name="python3").execute()
    shown = [data for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs
             for data in output.get("data", {})]
    asked_for = sum(".plot." in cell.source for cell in notebook.cells if cell.cell_type == "code")
    pictures, blocks = shown.count("image/png"), shown.count("text/html")
    print(f"{len(notebook.cells)} cells, {pictures} pictures, {blocks} blocks of HTML")
    assert asked_for > 0 and pictures >= asked_for, "a cell that plots has shown no picture"
    assert blocks > 0, "no verdict was shown"


if __name__ == "__main__":
    main(sys.argv[1])
