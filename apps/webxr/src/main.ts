import './ui/style.css';
import { App } from './app.ts';
import { transformSupport } from './peer/encoded-transform.ts';
import { readSettings } from './settings.ts';
import { failureWords } from './status/words.ts';
import { loadStored, pageOrigin } from './stored-settings.ts';
import { installTestApi } from './test-hooks.ts';
import { showFailure } from './ui/notice.ts';

const settings = readSettings(new URLSearchParams(window.location.search), loadStored(), pageOrigin());

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
