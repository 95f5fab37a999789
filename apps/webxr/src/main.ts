import './ui/style.css';
import { App } from './app.ts';
import { transformSupport } from './peer/encoded-transform.ts';
import { readSettings } from './settings.ts';
import { failureWords } from './status/words.ts';
import { installTestApi } from './test-hooks.ts';
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
  const isDirect = settings.bridge === null;
  if (isDirect && typeof RTCPeerConnection === 'undefined') {
    showFailure(failureWords.noWebRtc);
    return;
  }
  if (isDirect && transform === 'none') {
    showFailure(failureWords.noTransform);
    return;
  }
  try {
    const app = new App(settings, transform);
    app.start();
    installTestApi(app);
  } catch (error) {
    console.error(error);
    showFailure(failureWords.noWebGl2);
  }
}

start();
