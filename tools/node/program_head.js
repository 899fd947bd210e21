// Put before a program that Emscripten makes for Node.js. Its optimizer of scripts does not know ?. and ??.

// Emscripten would load the program by fetch, which reads no files here.
globalThis.fetch = undefined;

// Emscripten takes standard input, output and errors for terminals.
Module.onRuntimeInitialized = () => {
  for (const number of [0, 1, 2]) FS.streams[number].tty = require('tty').isatty(number);
};

// Where the program lies.
Module.programFolder = () => require('fs').realpathSync(__dirname);

// Runs another program and waits for its end: an sbfi_process_end, or -1 if it could not be run.
Module.runProgram = (words, wallMs, outputBytes) => {
  const child = require('child_process').spawnSync(process.execPath, words, {
    stdio: ['ignore', 'pipe', 'pipe'],
    timeout: wallMs || undefined,
    maxBuffer: outputBytes || Infinity,
    killSignal: 'SIGKILL',
    windowsHide: true,
  });
  const { error, signal } = child, ends = { ETIMEDOUT: 2, ENOBUFS: 4 };
  return {
    end: error ? ends[error.code] || -1 : signal ? 1 : 0,
    status: child.status,
    signal: signal && (require('os').constants.signals[signal] || 1),
    output: child.stdout || Buffer.alloc(0),
    words: child.stderr && child.stderr.length ? child.stderr : Buffer.from(error ? error.message : ''),
  };
};
