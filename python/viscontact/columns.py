"""A table as a dictionary of arrays, which results.py and the C++ sources of the module return.

A column that a table lacks raises KeyError as an entry and AttributeError as an attribute. Lengths
and types of the arrays are not checked. A change must keep that a table is a dictionary.
"""


class Columns(dict):
    """Arrays of equal length by name, each also an attribute: table["gap"] is table.gap.

    Their units are those of the file or the case that they come from.

    about      further values by name, such as the comments of a file
    pandas()   the table as a pandas.DataFrame; a column of vectors becomes one column for each
               component; ImportError without pandas
    """

    def __init__(self, columns=(), about=None):
        super().__init__(columns)
        self.about = {} if about is None else about

    def __getattr__(self, name):
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f"the table has no column '{name}'; it has "
                                 f"{', '.join(self)}") from None

    def __dir__(self):
        return [*super().__dir__(), *self]

    def __repr__(self):
        rows = len(next(iter(self.values()))) if self else 0
        return f"<viscontact.Columns {', '.join(self)}: {rows} rows>"

    def pandas(self):
        import pandas

        flat = {}
        for name, column in self.items():
            if getattr(column, "ndim", 1) == 1:
                flat[name] = column
            else:
                for i in range(column.shape[1]):
                    flat[f"{name}_{i}"] = column[:, i]
        return pandas.DataFrame(flat)
