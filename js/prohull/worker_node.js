import {parentPort} from 'node:worker_threads';
import {answer} from './worker.js';

parentPort.on('message', (message) => answer(message, (reply, transfer) => parentPort.postMessage(reply, transfer)));
