import './ui/style.css';
import { App } from './app.ts';
import { transformSupport } from './peer/encoded-transform.ts';
import { readSettings } from './settings.ts';
import { failureWords } from './status/words.ts';
import { showFailure } from './ui/notice.ts';
import { loadStored } from './ui/settings-dialog.ts';

const { protocol, hostname, host, search } = window.location;
const settings = readSettings(new URLSearchParams(search), loadStored(), {
  protocol,
  hostname,
  host,
  isDevServer: import.meta.env.DEV,
});

function start(): void {
  const transform = transformSupport();
  if (typeof RTCPeerConnection === 'undefined') return showFailure(failureWords.noWebRtc);
  if (transform === 'none') return showFailure(failureWords.noTransform);
  let app: App;
  try {
    app = new App(settings, transform);
  } catch (error) {
    console.error(error);
    return showFailure(failureWords.noWebGl2);
  }
  app.start();
}

start();
