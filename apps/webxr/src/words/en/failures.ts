/** What keeps the page from working, and what its server keeps from it. */

export const failures = {
  noWebGl2: {
    title: 'This browser cannot draw the point cloud',
    text: 'WebGL 2 is missing, or hardware acceleration is off. Turn hardware acceleration on, or use another browser.',
  },
  noWebRtc: {
    title: 'This browser has no WebRTC',
    text: 'Use a current Chrome, Edge, Safari or the headset’s own browser. Open the page over https or on localhost.',
  },
  noTransform: {
    title: 'This browser cannot receive point packets',
    text: 'It lacks encoded transforms (RTCRtpScriptTransform). Update the browser; a Quest needs version 42 or newer.',
  },
  workerFailed: {
    title: 'The point decoder could not start',
    text: 'Reload the page. If that does not help, the server is not delivering the page’s WebAssembly file.',
  },
  contextLost: {
    title: 'The graphics system was reset',
    text: 'The picture returns automatically in a moment.',
  },
  forbiddenAddress: (address: string) =>
    `This page may not connect to ${address}. Whoever runs its server can allow it (--connect-origins).`,
};
