// Put before a program that Emscripten makes for Node.js.

// Emscripten would load the program by fetch, which reads no files here.
globalThis.fetch = undefined;

// Emscripten takes standard input, output and errors for terminals.
Module.onRuntimeInitialized = () => {
  for (const number of [0, 1, 2]) FS.streams[number].tty = require('tty').isatty(number);
};
