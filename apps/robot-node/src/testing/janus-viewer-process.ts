/** A viewer in a process of its own, which a test can stop: `node janus-viewer-process.ts URL MOUNTPOINT PIN`. */
import { JanusViewer } from './janus-viewer.ts';

const [url = '', mountpoint = '', pin = ''] = process.argv.slice(2);
const viewer = await JanusViewer.watch({ url, mountpoint: Number(mountpoint), pin });
await viewer.until(() => [...viewer.videos.values()].some(({ frames }) => frames > 5));
console.log('watching');
process.once('SIGTERM', () => void viewer.close().then(() => process.exit(0)));
