// A worker of pool.js: makes one call at a time, reports its progress, and sends back its status with the text of its error.
import { parentPort, workerData } from 'node:worker_threads';
import koffi from 'koffi';
import { callbackType } from './callbacks.js';
import { Native } from './native.js';

const CANCEL = 0;
let paths = {};
const native = new Native((name) => paths[name]);

const progress = koffi.register((fraction) => {
  parentPort.postMessage({ fraction });
  return Atomics.load(workerData.control, CANCEL);
}, callbackType('locus_progress_fn'));

parentPort.on('message', ({ name, args, paths: told }) => {
  paths = told;
  let answer;
  try {
    answer = native.call(name, args);
  } catch (error) {
    answer = { thrown: error.message };
  }
  parentPort.postMessage(answer);
});
parentPort.postMessage({ progress });
