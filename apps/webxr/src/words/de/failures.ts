import type { Texts } from '../en/catalogue.ts';

export const failures: Texts['failures'] = {
  noWebGl2: {
    title: 'Dieser Browser kann die Punktwolke nicht zeichnen',
    text: 'WebGL 2 fehlt, oder die Hardwarebeschleunigung ist aus. Schalten Sie die Hardwarebeschleunigung ein oder nehmen Sie einen anderen Browser.',
  },
  noWebRtc: {
    title: 'Dieser Browser hat kein WebRTC',
    text: 'Verwenden Sie ein aktuelles Chrome, Edge oder Safari oder den Browser des Headsets. Öffnen Sie die Seite über https oder auf localhost.',
  },
  noTransform: {
    title: 'Dieser Browser kann keine Punktpakete empfangen',
    text: 'Ihm fehlen „Encoded Transforms“ (RTCRtpScriptTransform). Aktualisieren Sie den Browser; eine Quest braucht Version 42 oder neuer.',
  },
  workerFailed: {
    title: 'Der Punktdecoder konnte nicht starten',
    text: 'Laden Sie die Seite neu. Hilft das nicht, liefert der Server die WebAssembly-Datei der Seite nicht aus.',
  },
  contextLost: {
    title: 'Das Grafiksystem wurde zurückgesetzt',
    text: 'Das Bild kommt gleich von selbst wieder.',
  },
  forbiddenAddress: (address) =>
    `Diese Seite darf sich nicht mit ${address} verbinden. Wer ihren Server betreibt, kann es erlauben (--connect-origins).`,
};
