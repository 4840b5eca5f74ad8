import fnmatch, os, sys, tarfile, zipfile
archive, pattern, folder = sys.argv[1:]
if zipfile.is_zipfile(archive):
    archive = zipfile.ZipFile(archive)
    for name in fnmatch.filter(archive.namelist(), pattern):
        path = archive.extract(name, folder)
        # zipfile forgets which files are programs.
        if archive.getinfo(name).external_attr >> 16 & 0o100:
            os.chmod(path, 0o755)
else:
    archive = tarfile.open(archive)
    archive.extractall(folder, [m for m in archive.getmembers() if fnmatch.fnmatch(m.name, pattern)])
