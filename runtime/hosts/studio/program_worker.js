/* The program `sbfmt` in a worker of a browser, with files in memory. It stands behind the two scripts that Emscripten makes,
 * and takes { modules } once, then calls { arguments, files }. It posts { progress: { what, fraction } } and { line } as they
 * come, and at the end { done: { status, output, errors, files } }: `files` are those that the call made or changed. Whoever
 * wants to cancel terminates the worker. */
const FOLDER = '/work', PROGRAM_FOLDER = '/program';
const EXITED = 0, TOO_LARGE = 4, CANNOT_RUN = -1;
const PROGRESS = /\r\x1b\[K(?:([^\r\n]*?) +(\d+) %)?/g;
/* Programs: the functions that Emscripten makes, by their file. */
const programs = { 'sbfmt.js': globalThis.sbfmtProgram, 'sbfmt-import.js': globalThis.sbfmtImportProgram };
let modules = {};

/** Writes files into the memory of a program, its folders made; the bytes are shared with others that have them. */
function writeFiles(FS, files) {
  for (const [path, bytes] of files) {
    FS.mkdirTree(path.slice(0, path.lastIndexOf('/')) || '/');
    FS.writeFile(path, bytes, { canOwn: true });
  }
}

/** Files below a folder: [[path, bytes]]. */
function filesBelow(FS, folder) {
  return FS.readdir(folder).filter((name) => name !== '.' && name !== '..').flatMap((name) => {
    const path = `${folder}/${name}`;
    return FS.isDir(FS.stat(path).mode) ? filesBelow(FS, path) : [[path, FS.readFile(path)]];
  });
}

/** Has `take` receive the bytes that a program writes to a stream, as they come. */
function listenTo(FS, number, take, isTerminal) {
  Object.assign(FS.streams[number], { tty: isTerminal, stream_ops: { write: (_, buffer, offset, length) => {
    take(new Uint8Array(buffer.buffer, buffer.byteOffset + offset, length).slice());
    return length;
  } } });
}

function joined(chunks) {
  const bytes = new Uint8Array(chunks.reduce((sum, one) => sum + one.length, 0));
  let at = 0;
  for (const one of chunks) bytes.set(one, at), at += one.length;
  return bytes;
}

/** Runs a program to its end. `onError` receives the bytes of standard error. */
function runProgram(name, words, files, onOutput, onError) {
  let status = 0;
  const program = programs[name]({
    thisProgram: `${PROGRAM_FOLDER}/${name}`,
    instantiateWasm: (imports, receive) => {
      const instance = new WebAssembly.Instance(modules[name], imports);
      receive(instance);
      return instance.exports;
    },
    programFolder: () => PROGRAM_FOLDER,
    runProgram: (childWords, wallMs, outputBytes) => runChild(program, childWords, outputBytes),
    onExit: (code) => { status = code; },
  });
  const { FS, ENV } = program;
  FS.mkdirTree(FOLDER);
  writeFiles(FS, [...files, ...Object.keys(programs).map((one) => [`${PROGRAM_FOLDER}/${one}`, new Uint8Array(0)])]);
  FS.chdir(FOLDER);
  ENV.HOME = ENV.TMPDIR = '/tmp';
  listenTo(FS, 1, onOutput, false);
  listenTo(FS, 2, onError, name === 'sbfmt.js'); // progress is for terminals alone
  program.callMain(words);
  return { status, FS };
}

/** What process_node.c wants of a child: see tools/node/program_head.js. */
function runChild(parent, [path, ...words], outputBytes) {
  const output = [], errors = [];
  let size = 0;
  const result = (end, status, said = joined(errors)) => ({ end, status, signal: end > 0 ? 9 : 0, output: end ? new Uint8Array(0) : joined(output), words: said });
  try {
    const { status } = runProgram(path.slice(path.lastIndexOf('/') + 1), words, filesBelow(parent.FS, FOLDER), (bytes) => {
      output.push(bytes);
      size += bytes.length;
      if (outputBytes && size > outputBytes) throw new RangeError('more output than is allowed');
    }, (bytes) => errors.push(bytes));
    return result(EXITED, status);
  } catch (error) {
    if (error instanceof RangeError && outputBytes && size > outputBytes) return result(TOO_LARGE, 0);
    if (error instanceof WebAssembly.RuntimeError || error instanceof RangeError) return { ...result(1, 0), signal: 6 };
    return result(CANNOT_RUN, 0, new TextEncoder().encode(String(error?.message ?? error)));
  }
}

/** Text of standard error, apart into lines and progress. */
class Errors {
  constructor() {
    this.decoder = new TextDecoder();
    this.text = '';
    this.lines = [];
  }
  add(bytes) {
    this.text += this.decoder.decode(bytes, { stream: true });
    let last;
    const kept = this.text.replace(PROGRESS, (_, what, percent) => ((last = what && { what, fraction: percent / 100 }), ''));
    if (last) postMessage({ progress: last });
    const lines = kept.split('\n');
    this.text = lines.pop();
    for (const line of lines) this.tell(line);
  }
  tell(line) {
    if (!line) return;
    this.lines.push(line);
    postMessage({ line });
  }
}

function sameBytes(a, b) {
  return a?.length === b.length && a.every((byte, i) => byte === b[i]);
}

function answer({ arguments: words, files }) {
  const given = new Map([...files].map(([name, bytes]) => [name.startsWith('/') ? name : `${FOLDER}/${name}`, bytes]));
  const output = [], errors = new Errors(), copies = [...given].map(([path, bytes]) => [path, bytes.slice()]);
  let status, made = [];
  try {
    const done = runProgram('sbfmt.js', words, copies, (bytes) => output.push(bytes), (bytes) => errors.add(bytes));
    status = done.status;
    made = filesBelow(done.FS, FOLDER).filter(([path, bytes]) => !sameBytes(given.get(path), bytes))
      .map(([path, bytes]) => [path.slice(FOLDER.length + 1), bytes]);
  } catch (error) {
    status = 70;
    errors.tell(`sbfmt: error: the program stopped: ${error?.message ?? error}`);
  }
  postMessage({ done: { status, output: new TextDecoder().decode(joined(output)), errors: errors.lines, files: new Map(made) } }, made.map(([, bytes]) => bytes.buffer));
}

onmessage = ({ data }) => {
  if (data.modules) ({ modules } = data);
  else answer(data);
};
