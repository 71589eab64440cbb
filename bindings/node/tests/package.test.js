// The package: made from the headers as they are, finds its library, is typed as it is, and its README runs.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { cpSync, readFileSync, realpathSync, symlinkSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import test from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';
import ts from 'typescript';
import * as locus from '../lib/index.js';
import { STRUCTS } from '../lib/interface.js';
import { scratch } from './common.js';

const HERE = dirname(dirname(fileURLToPath(import.meta.url)));
const INDEX = join(HERE, 'lib', 'index.js');

/** Run a program with other variables of the environment; undefined removes one. */
function node(program, variables = {}, index = INDEX, cwd = '/') {
  const env = { ...process.env, ...variables };
  for (const [name, value] of Object.entries(variables)) if (value === undefined) delete env[name];
  const text = program.replaceAll("'locus'", `'${pathToFileURL(index).href}'`);
  return spawnSync(process.execPath, ['--input-type=module', '-e', text], { encoding: 'utf8', env, cwd });
}

const SAY = "import { LIBRARY_PATH } from 'locus'; console.log(LIBRARY_PATH);";

test('what is made from the headers is current', () => {
  const done = spawnSync(join(HERE, 'generate.py'), ['--check'], { encoding: 'utf8' });
  assert.equal(done.status, 0, done.stdout + done.stderr);
});

test('finds the library where it is told', (t) => {
  const file = scratch(t);
  const library = realpathSync(locus.LIBRARY_PATH);
  assert.equal(node(SAY, { LOCUS_LIBRARY: library }).stdout.trim(), library);
  symlinkSync(library, file('liblocus.so.0'));
  assert.equal(node(SAY, { LOCUS_LIBRARY: file('.') }).stdout.trim(), file('liblocus.so.0'));
  assert.equal(node(SAY, { LOCUS_LIBRARY: undefined, LD_LIBRARY_PATH: file('.') }).stdout.trim(), 'liblocus.so.0');
  cpSync(join(HERE, 'lib'), file('package/lib'), { recursive: true });
  cpSync(join(HERE, 'package.json'), file('package/package.json'));
  symlinkSync(join(HERE, 'node_modules'), file('package/node_modules'));
  symlinkSync(library, file('package/lib/liblocus.so.0'));
  const beside = node(SAY, { LOCUS_LIBRARY: undefined }, file('package/lib/index.js'));
  assert.equal(beside.stdout.trim(), realpathSync(file('package/lib')) + '/liblocus.so.0', beside.stderr);
  writeFileSync(file('locus.pc'), `libdir=${file('.')}\nName: locus\nDescription: x\nVersion: 0.1.0\n`);
  const told = node(SAY, { LOCUS_LIBRARY: undefined, PKG_CONFIG_PATH: file('.') });
  assert.ok([file('liblocus.so.0'), 'liblocus.so.0'].includes(told.stdout.trim()), told.stderr);
});

test('says when there is no library, or another one', (t) => {
  const file = scratch(t);
  const none = node(SAY, { LOCUS_LIBRARY: file('none.so') });
  assert.match(none.stderr, /LibraryError: LOCUS_LIBRARY is .*none.so/);
  assert.match(node(SAY, { LOCUS_LIBRARY: 'libm.so.6' }).stderr, /LibraryError: libm.so.6 is not liblocus/);
  for (const [version, refused] of [[0x7fffffff, true], [10000, true], [0, true], [9999, false]]) {
    writeFileSync(file('other.c'), `#include <stdint.h>\nuint32_t locus_version(void) { return ${version}; }\n`);
    assert.equal(spawnSync('cc', ['-shared', '-fPIC', file('other.c'), '-o', file('other.so')]).status, 0);
    const done = node("import 'locus';", { LOCUS_LIBRARY: file('other.so') });
    assert.equal(/LibraryError: .* is version/.test(done.stderr), refused, done.stderr);
  }
});

/** The types, checked by the compiler. */
function program() {
  const file = join(HERE, 'tsconfig.json');
  const config = ts.parseJsonConfigFileContent(ts.readConfigFile(file, ts.sys.readFile).config, ts.sys, HERE, undefined, file);
  return ts.createProgram(config.fileNames, config.options);
}

test('the types are those of the package', () => {
  const made = program();
  const problems = ts.getPreEmitDiagnostics(made).map(({ messageText, file, start }) => {
    const text = ts.flattenDiagnosticMessageText(messageText, ' ');
    return file ? `${file.fileName}:${file.getLineAndCharacterOfPosition(start).line + 1}: ${text}` : text;
  });
  assert.deepEqual(problems, []);
  const checker = made.getTypeChecker();
  const declared = checker.getExportsOfModule(checker.getSymbolAtLocation(made.getSourceFile(join(HERE, 'lib', 'index.d.ts'))));
  const isValue = (symbol) => {
    const whole = symbol.flags & ts.SymbolFlags.Alias ? checker.getAliasedSymbol(symbol) : symbol;
    return (whole.flags & ts.SymbolFlags.Value) !== 0;
  };
  const values = declared.filter(isValue);
  assert.deepEqual(values.map(({ name }) => name).sort(), Object.keys(locus).sort());
  const members = (type) => new Set(type.getProperties().map(({ name }) => name).filter((name) => !name.startsWith('__')));
  for (const symbol of values) {
    const value = locus[symbol.name];
    const type = checker.getTypeOfSymbol(symbol.flags & ts.SymbolFlags.Alias ? checker.getAliasedSymbol(symbol) : symbol);
    if (value !== null && typeof value === 'object') {
      assert.deepEqual([...members(type)].sort(), Object.keys(value).sort(), `the members of ${symbol.name}`);
    }
    if (typeof value !== 'function' || !/^class/.test(String(value)) || value.prototype instanceof Error) continue;
    const instance = members(type.getConstructSignatures()[0].getReturnType());
    const own = new Set();
    for (let at = value.prototype; at !== Object.prototype; at = Object.getPrototypeOf(at)) {
      for (const name of Object.getOwnPropertyNames(at)) if (name !== 'constructor') own.add(name);
    }
    for (const name of own) assert.ok(instance.has(name), `${symbol.name}.${name} is not declared`);
    for (const name of Object.getOwnPropertyNames(value).filter((one) => typeof value[one] === 'function')) {
      assert.ok(members(type).has(name), `${symbol.name}.${name} is not declared`);
    }
    const declaredType = type.getConstructSignatures()[0].getReturnType();
    const isMethod = (name) => checker.getTypeOfSymbol(declaredType.getProperty(name)).getCallSignatures().length > 0;
    for (const name of [...instance].filter(isMethod)) assert.ok(own.has(name), `${symbol.name}.${name} does not exist`);
  }
});

test('what calls report has the fields that the types name', () => {
  const text = ['common', 'voxels', 'stream', 'cold', 'files'].map((name) => readFileSync(join(HERE, 'lib', `${name}.d.ts`), 'utf8')).join('\n');
  const reported = Object.keys(STRUCTS).filter((name) => /^locus_.*_(info|stats|recovery)$/.test(name));
  assert.ok(reported.length >= 10);
  for (const struct of reported) {
    const name = struct.replace(/^locus|_([a-z])/g, (_, letter) => (letter ?? '').toUpperCase());
    const body = text.match(new RegExp(`interface ${name} \\{([^}]*)\\}`))?.[1];
    assert.ok(body, `there is no interface ${name}`);
    const fields = [...body.matchAll(/^ {2}(\w+):/gm)].map(([, field]) => field);
    const wanted = Object.keys(STRUCTS[struct].fields).filter((field) => field !== 'struct_size' && !field.startsWith('reserved'));
    assert.deepEqual(fields, wanted.map((field) => field.replace(/_([a-z])/g, (_, letter) => letter.toUpperCase())), name);
  }
});

test('the readme runs', (t) => {
  const folder = scratch(t)('.');
  const text = readFileSync(join(HERE, 'README.md'), 'utf8');
  const programs = [...text.matchAll(/^```js\n(.*?)^```\n(?:\nprints\n\n```text\n(.*?)^```)?/gms)];
  assert.ok(programs.length > 0);
  for (const [, code, printed = ''] of programs) {
    const done = node(code, {}, INDEX, folder);
    assert.deepEqual([done.status, done.stdout], [0, printed], done.stderr);
  }
});
