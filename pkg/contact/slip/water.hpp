// The line between liquid water and vapour, after Vardoulakis (Taboada and Estrada 2009, eq. 14):
//     p_ev ≈ 62 T exp(−4650/T) MPa ,   T the absolute temperature .
// Held against IAPWS-IF97: −12 % at 100 °C, +2 % at 200 °C, +13 % at 250 °C, +24 % at 300 °C. There is no such line
// above 374 °C and 22 MPa, where the formula goes on.
#pragma once

#include <cmath>

namespace nonsmooth::contact::slip {

constexpr double zeroCelsius = 273.15; // [K]

/// p_ev [Pa] at a temperature [°C], eq. (14).
inline double vapourPressure(double temperature)
{
	const double kelvin = temperature + zeroCelsius;
	return 62e6 * kelvin * std::exp(-4650 / kelvin);
}

/// Temperature [°C] at which water of a pressure [Pa], absolute and positive, turns to vapour.
inline double boilingTemperature(double pressure)
{
	double kelvin = 400; // Newton on ln p_ev, which rises with T and is nearly straight in 1/T
	for (int k = 0; k < 50; ++k)
		kelvin /= 1 + std::log(vapourPressure(kelvin - zeroCelsius) / pressure) / (1 + 4650 / kelvin);
	return kelvin - zeroCelsius;
}

} // namespace nonsmooth::contact::slip
