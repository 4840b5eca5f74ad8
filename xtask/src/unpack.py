import fnmatch, sys, tarfile, zipfile
archive, pattern, folder = sys.argv[1:]
if zipfile.is_zipfile(archive):
    archive = zipfile.ZipFile(archive)
    archive.extractall(folder, fnmatch.filter(archive.namelist(), pattern))
else:
    archive = tarfile.open(archive)
    archive.extractall(folder, [m for m in archive.getmembers() if fnmatch.fnmatch(m.name, pattern)])
