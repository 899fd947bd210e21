/* Films the picture, until it is told to stop. */
import { save } from './studio_take.js';

const FRAMES_A_SECOND = 30, BITS_A_SECOND = 8e6;

export class Film {
  constructor(canvas, name) {
    const type = ['video/webm;codecs=vp9', 'video/webm', 'video/mp4'].find((one) => MediaRecorder.isTypeSupported(one));
    this.recorder = new MediaRecorder(canvas.captureStream(FRAMES_A_SECOND), { mimeType: type, videoBitsPerSecond: BITS_A_SECOND });
    const chunks = [];
    this.recorder.ondataavailable = ({ data }) => chunks.push(data);
    this.recorder.onstop = () => save(`${name}.${/mp4/.test(type) ? 'mp4' : 'webm'}`, new Blob(chunks, { type }));
    this.recorder.start();
  }
  /** Ends it, and saves it. */
  stop() {
    this.recorder.stop();
    for (const track of this.recorder.stream.getTracks()) track.stop();
  }
}
