import {answer} from './worker.js';

self.onmessage = (event) => answer(event.data, (reply, transfer) => self.postMessage(reply, transfer));
