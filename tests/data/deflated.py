"""Contact problems that take less room."""
import h5py


def deflate(source, target):
    """The same datasets, each deflated: our reader and h5py notice nothing."""
    with h5py.File(source, "r") as old, h5py.File(target, "w") as new:
        new.attrs.update(old.attrs)

        def copy(name, item):  # a walk goes on as long as this returns None
            if isinstance(item, h5py.Dataset):
                new.create_dataset(name, data=item[()], compression="gzip", compression_opts=9, shuffle=True)

        old.visititems(copy)
