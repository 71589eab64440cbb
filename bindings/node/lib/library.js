// Find liblocus, liblocus_io and liblocus_cold.
import { spawnSync } from 'node:child_process';
import { existsSync, statSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { CONSTANTS } from './interface.js';
import { LibraryError } from './errors.js';
import { Native } from './native.js';

const SONAME = `.so.${CONSTANTS.VERSION_MAJOR}`;
const VARIABLES = { liblocus: 'LOCUS_LIBRARY', liblocus_io: 'LOCUS_IO_LIBRARY', liblocus_cold: 'LOCUS_COLD_LIBRARY' };
const opened = {};

/** The folder of libraries that pkg-config names. */
function pkgConfigFolder(name) {
  const found = spawnSync('pkg-config', ['--variable=libdir', name.replace(/^lib/, '')], { encoding: 'utf8' });
  return found.status === 0 ? found.stdout.trim() : '';
}

/** Where a library may be, in the order in which the places are tried; a bare name leaves it to the loader. */
function* places(name) {
  const file = name + SONAME;
  const folders = [dirname(fileURLToPath(import.meta.url))];
  if (name !== 'liblocus' && opened.liblocus?.includes('/')) folders.unshift(dirname(opened.liblocus));
  for (const folder of folders) if (existsSync(join(folder, file))) yield join(folder, file);
  yield file;
  const told = pkgConfigFolder(name);
  if (told && existsSync(join(told, file))) yield join(told, file);
}

/** Open a library from where its environment variable says, else from the other places. */
function find(name) {
  const variable = VARIABLES[name];
  const named = process.env[variable];
  if (named) {
    const path = statSync(named, { throwIfNoEntry: false })?.isDirectory() ? join(named, name + SONAME) : named;
    const reason = refused(name, path);
    if (reason) throw new LibraryError(`${variable} is ${named}: ${reason}`);
    return path;
  }
  let why = '';
  for (const path of places(name)) {
    const reason = refused(name, path);
    if (!reason) return path;
    why ||= reason;
  }
  throw new LibraryError(
    `${name + SONAME} was not found beside the package, by the loader (${why}) or by pkg-config. Install Locus (make install), or set ` +
      `${variable} to the path of the library or of its folder.`,
  );
}

/** Why a library does not open; nothing where it does. */
function refused(name, path) {
  try {
    new Native(() => path).library(name);
    return '';
  } catch (error) {
    return error.message;
  }
}

function open(name) {
  opened[name] ??= find(name);
  return opened[name];
}

/** The functions on this thread. */
export const native = new Native(open);

function checkVersion() {
  const path = open('liblocus');
  let version;
  try {
    version = native.get('locus_version')();
  } catch {
    throw new LibraryError(`${path} is not liblocus: it has no locus_version`);
  }
  const [major, minor, patch] = [Math.trunc(version / 10000), Math.trunc(version / 100) % 100, version % 100];
  if (major !== CONSTANTS.VERSION_MAJOR || minor < CONSTANTS.VERSION_MINOR) {
    throw new LibraryError(
      `${path} is version ${major}.${minor}.${patch}; this package needs ${CONSTANTS.VERSION_MAJOR}.${CONSTANTS.VERSION_MINOR} or a ` +
        `later ${CONSTANTS.VERSION_MAJOR}.x`,
    );
  }
  return path;
}

/** The path or name that liblocus was opened by. */
export const LIBRARY_PATH = checkVersion();

/** The paths of the libraries, for a worker; but liblocus only where `name` asks for them. */
export function pathsFor(name) {
  open(name);
  return { ...opened };
}

/** The loaded library's version and what was built into it, such as `0.1.0 simd=highway cuda=no`. */
export function version() {
  return native.get('locus_version_text')();
}
