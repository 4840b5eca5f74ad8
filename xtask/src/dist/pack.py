import gzip, os, sys, tarfile, zipfile

# The same files give the same archive: names in order, one owner, one date, the earliest that zip has.
folder, archive, program = sys.argv[1:]
above, name = os.path.split(folder)
files = [(name + "/" + file, 0o755 if file == program else 0o644) for file in sorted(os.listdir(folder))]
if archive.endswith(".zip"):
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as packed:
        for file, mode in files:
            entry = zipfile.ZipInfo(file)
            entry.compress_type, entry.create_system, entry.external_attr = zipfile.ZIP_DEFLATED, 3, (0o100000 | mode) << 16
            packed.writestr(entry, open(os.path.join(above, file), "rb").read())
else:
    with open(archive, "wb") as raw, gzip.GzipFile("", "wb", 9, raw, 0) as zipped, tarfile.open(fileobj=zipped, mode="w") as packed:
        for file, mode in files:
            entry = tarfile.TarInfo(file)
            entry.size, entry.mode, entry.mtime = os.path.getsize(os.path.join(above, file)), mode, 315532800
            with open(os.path.join(above, file), "rb") as content:
                packed.addfile(entry, content)
