import './style/tokens.css';
import './style/base.css';
import './style/controls.css';
import './style/layout.css';
import './style/picture.css';
import './style/light.css';

import { render } from 'preact';

import { App } from './view/App.tsx';

render(<App />, document.getElementById('page')!);
