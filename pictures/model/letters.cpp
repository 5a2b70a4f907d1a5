// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/model/letters.hpp"

#include <array>
#include <string_view>

#include "core/base/printable.hpp"

namespace warren {
// The outlines of ASCII's and Latin-1's letters, so that pictures in pixels don't depend on a machine's fonts. Glyphs
// of U+0020 to U+007E and U+00A0 to U+00FF, apart by blanks. All numbers are pairs of digits in base 64 (A-Z a-z 0-9 +
// /): a glyph is its advance and its contours, a contour the count of its points and these, a point x + 1024 and
// 2 (y + 512) + (1 if it is on the curve): TrueType's quadratic curves, 1024 units to the letters' size.
//
// Derived from DejaVu Sans 2.37 with another name, as its licence asks. Copyright (c) 2003 by Bitstream, Inc. All
// Rights Reserved. Bitstream Vera is a trademark of Bitstream, Inc. DejaVu changes are in public domain. Permission is
// hereby granted, free of charge, to any person obtaining a copy of the fonts accompanying this license ("Fonts") and
// associated documentation files (the "Font Software"), to reproduce and distribute the Font Software, including
// without limitation the rights to use, copy, merge, publish, distribute, and/or sell copies of the Font Software, and
// to permit persons to whom the Font Software is furnished to do so, subject to the following conditions: The above
// copyright and trademark notices and this permission notice shall be included in all copies of one or more of the Font
// Software typefaces. The Font Software may be modified, altered, or added to, and in particular the designs of glyphs
// or characters in the Fonts may be modified and additional glyphs or characters may be added to the Fonts, only if the
// fonts are renamed to names not containing either the words "Bitstream" or the word "Vera". This License becomes null
// and void to the extent applicable to Fonts or Font Software that has been modified and is distributed under the
// "Bitstream Vera" names. The Font Software may be sold as part of a larger software package but no copy of one or more
// of the Font Software typefaces may be sold by itself. THE FONT SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY
// KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT LIMITED TO ANY WARRANTIES OF MERCHANTABILITY, FITNESS FOR A PARTICULAR
// PURPOSE AND NONINFRINGEMENT OF COPYRIGHT, PATENT, TRADEMARK, OR OTHER RIGHT. IN NO EVENT SHALL BITSTREAM OR THE GNOME
// FOUNDATION BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER LIABILITY, INCLUDING ANY GENERAL, SPECIAL, INDIRECT, INCIDENTAL,
// OR CONSEQUENTIAL DAMAGES, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM, OUT OF THE USE OR
// INABILITY TO USE THE FONT SOFTWARE OR FROM OTHER DEALINGS IN THE FONT SOFTWARE.

inline constexpr std::string_view letter_outlines =
    "FG GaAESaT/UAT/UAQBSaQBAGSanVUAnVUAdHT2XhSlXhSadH HXAES4nVS4erRierRinVAEV0nVV0erUgerUgnV NaAEYMeFV6eFVQY5XiY5AcX"
    "Am/WMghYeghZTm/ajm/ZwghcMghcMeFZceFYzY5bSY5bSWfYgWfXsQBWcQBXPWfU8WfUJQBS4QBTsWfRPWfRPY5T/Y5UpeFSIeFSIghU8ghVwm/ "
    "KMAiVaLVUoLVUoQBTzQCSKQwRVRdRVURSITQTwSQUoSPUoZXS6Z6RVcmRVe9RVhgTCkcUokpUooVVaoVVaktWIkoXgkIYJjvYJhBXghoWIiYVaid"
    "VabxXMbMY2YYY2V9Y2TUXFQQVaQDAHUocDUoidTuiQSxgkSxfNSxd4TqcYAHVaZDVaSRWaSiXaUQXaVrXaXCWcYq PNAMboaRa9aQaMX8aMV5aMT"
    "4a9RiboRjcTRidET4dEV5dEX8cTaQAMbocRc4cQeUY0eUV5eUS+c3PkboPlaYPkY8S+Y8V5Y8Y0aZcQAMTklxS6lwSIjcSIhbSIfWS5dCTkdDUQd"
    "CVCfWVChbVCjcUQlwAEaonxb4nxUlPlTVPlAMTknxU0nwWSkUWShbWSecU0bETkbFSVbEQ4eeQ4hbQ4kUSWnw MeAKT5clTMbSShYwShXZShVIUL"
    "SEVbSFWKSEXeTEYCUFAnVAeVY+WNZbXkZ8awZ/chbcchbWacaiWcZ0Udb/QBaBQBY6SVYGQ6WUPkVSPlTaPkRAT2RAXNRAZMSEcuTGeRSufQSWhM"
    "SWiJSWksUEnwVgnxWKnwXcnMYHmpYHjzXckgWMlSVqlTU2lST0jkT0iNT0hYUSfw EaAES4nVS4erRierRinV GQAOU+oTT6ksS6dqS6aFS6WcT7"
    "PYU+LzTuLzSiPcRYWkRYaFRYdiSikmTuoT GQAORSoTSioTTtkmU4diU4aFU4WkTtPcSiLzRSLzSUPYTWWcTWaFTWdqSUks IAASXijhUugdXidb"
    "XEb5UcfFUcZLTkZLTkfFQ8b5QedbTSgdQejhQ8lDTkh5TknxUcnxUch5XElD NaAMXXkFXXbZbubZbuYtXXYtXXQBWDQBWDYtRsYtRsbZWDbZWDk"
    "F FGAGR4T/TiT/TiRTSQMTRPMTR4RT FyAEQyaFVAaFVAXhQyXh FGAERuT/TXT/TXQBRuQB FZAEUEnVVZnVRVNDQAND KMAMVGlRT4lQSpgcSp"
    "bpSpW2T4SEVGSFWUSEXiW2XibpXigcWUlQAMVGnxXDnwZIhkZIbpZIVwXDPkVGPlTIPkREVwREbpREhkTInw KMALR/SrUkSrUkkdRwjVRwmNUjn"
    "VWInVWISrYtSrYtQBR/QB KMAdTESrYlSrYlQBRLQBRLSrSEUgVLayVkbtWVdYW8fwW8g5W8iwVolGUllHT2lGSMkERQjBRQmNSNm+T3nwUjnxWX"
    "nwYhkIYhhHYhfqX+dEXRbVXEa4U+Wk KMApWgclXocGY6ZCY6WzY6TUWiPkUWPlTmPkSDQIROQtROTxR4TATcSMUSSNVySMXVUkXVWzXVY2V4bMU"
    "mbNTPbNTPdxUqdxV0dwXEfoXEhZXEjMVylGUmlHT8lGSekiRkj9RkmxSenQUCnwUvnxWinwYokgYohtYofwXhdG KMADWDklSEYJWDYJALVonVXo"
    "nVXoYJZSYJZSVhXoVhXoQBWDQBWDVhQyVhQyYl KMAeRunVX7nVX7ktTLktTLe9ThfMUNfcUjfdWgfcYybIYyXhYyTuWcPkUUPlTkPkSDQERPQlR"
    "PTvR8S8TcSMUSSNVoSMXNVEXNXhXNZ8VocwUScxTpcwSYcMRubp KMAMVSc9UOc8S+aAS+XhS+U+UOSEVSSFWWSEXmU+XmXhXmaAWWc8AZYam1Ya"
    "j9X0kgWnlGWBlHUdlGS0g4SscpTKd+UifcVYfdXIfcZLbKZLXhZLT4XDPkVSPlTQPkRIVwRIbpRIhMTwnwV9nxWjnwXwnS KMAHRUnVY0nVY0mBU"
    "lQBS8QBW6ktRUkt KMAMVGbFT+bESrYsSrWlSrUcT+SEVGSFWOSEXgUeXgWlXgYsWObEAYTgcdSgc8RXfsRXhtRXkgTWnwVGnxW1nwY0kgY0htY0"
    "fsXsc8WrcdX0b4ZGY0ZGWlZGTMXBPkVGPlTKPkRGTMRGWlRGY0SYb4AMS8hbS8fmUEdkVGdlWGdkXQfmXQhbXQjOWGlQVGlRUElQS8jO KMAZRwQ"
    "hRwTZSWS0TkSMUKSNVuSMXYWaXfatXCZWVpX6UzX7TDX6RAcIRAf1RAjaTInwU6nxW7nwZEhkZEbpZEWIWcPkUOPlToPkSaQAAMU6aZV+aYXNdSX"
    "Nf1XNiUV+lQU6lRT2lQSmiUSmf1SmdST2aY FZAER4T/TiT/TiQBR4QBAER4glTiglTiclR4cl FZAER4glTiglTiclR4clAGR4T/TiT/TiRTSQM"
    "TRPMTR4RT NaAHbufxTqaBbuUVbuRfRsYxRsbVbuin NaAERsejbuejbub7Rsb7AERsYLbuYLbuVhRsVh NaAHRsfxRsinbubVbuYxRsRfRsUVZw"
    "aB IgAETET/UpT/UpQBTEQBAhUmWRTGWRTGYtTGaQTicSUQdpU8fBVZf2VyhUVyiFVyjeUxlMT7lNTUlMR6kGRKjFRKmBR4m4TZnwUMnxVonwXYk"
    "uXYiRXYhEW0e6WHdlVbcPVEbgUwaqUsaRUpZ8UmZAUmYN QAAMV9YZV9WKXEToYCTpZAToaGWMaGYZaGakY+dKYBdLXEdKV9amBBaOTvZwSgYiRY"
    "XuRZWYRYUtVQUtYZUtbgWZfcXufdYifcZweQaOdFaOfJbVfJbVTpceT8dwXcdwaNdwb4dRe0cxgFb9iIZokSYQkTXSkSVhjQUxiRTigsSKbgSKYh"
    "SKWATERqT6QBUuOYW4MsYHMtZIMsbEOCb4PVclNlbmMEZTKcYHKdWqKcUGMgTGOdSGQYREViREYhREbUSIggTGidUHkcWwmiYOmjZ4micuj0dshV"
    "eRfye4cMe4aRe4WKcaRaaORV K8ADVekPTVYpXoYpAIUlnVWYnVa0QBZLQBYHWBS2WBRyQBQIQB K+AJTKbJTKSnVsSnW9SmYMUsYMW5YMZEW9bI"
    "VsbJAJTKkxTKdtVfdtWpdsXyfcXyhPXyjAWpkwVfkxAPRknVVmnVXanUZXkUZXhlZXfcYXc4XZclYkcEZ2Y6Z2WjZ2TaXuQAVwQBRkQB LLAaaUl"
    "jaUiNZgjsXtlKWslLUslKSkgQSkbpSkXCUsSIWsSJXtSIZgToaUVHaUR1ZeQsXoPkWmPlT8PkQ6WCQ6bpQ6hQT8nwWmnxXpnwZgmo MUAJTKkxTK"
    "SnVESnXeSmZuW+ZubtZugYXekwVEkxAJRknVU0nVYNnUbYhsbYbtbYVqYMQAU0QBRkQB KHAMRknVY8nVY8ktTKktTKdxYtdxYtbJTKbJTKSrZGS"
    "rZGQBRkQB JNAKRknVYSnVYSktTKktTKd1Xyd1XybJTKbJTKQBRkQB MaAeZiTVZiZnW8ZnW8cNbGcNbGSNaLQ4X+PkWuPlT/PkQ6V8Q6bpQ6hYT"
    "/nwWunxX3nwZ6moayljayiNZ6jqX8lKW2lLUulKSkgYSkbpSkW8UuSIW2SJXsSIZASu MCAMRknVTKnVTKdxY4dxY4nVaenVaeQBY4QBY4bJTKbJ"
    "TKQBRkQB EuAERknVTKnVTKQBRkQB EuAMRknVTKnVTKRpTKNaRjJmPyJnPLJnPLMRPqMRQuMQRkOmRkRp KgALRknVTKnVTKdfYYnVaanVUocda"
    "1QBYwQBTKbRTKQBRkQB I6AGRknVTKnVTKSrY1SrY1QBRkQB N0ANRknVT7nVW6XdZ5nVcQnVcQQBatQBatkhXsUhWHUhTGkhTGQBRkQB L+AKRk"
    "nVTsnVY4T1Y4nVaanVaaQBYSQBTGjhTGQBRkQB MmAMWUlNUmlMSkgESkbpSkXQUmSIWUSJYCSIaCXQaCbpaCgEYClMAMWUnxYwnwbshMbsbpbsW"
    "IYwPkWUPlT2PkQ6WIQ6bpQ6hMT2nw JqAJTKkxTKb/VIb/WPb+XceQXcgZXcicWPkwVIkxALRknVVInVXGnUZGjyZGgZZGc6XGZYVIZZTKZZTKQB"
    "RkQB MmAMWUlNUmlMSkgESkbpSkXQUmSIWUSJYCSIaCXQaCbpaCgEYClMASYhQdamL5YsL5W+PpWtPkWcPkWUPlT2PkQ6WIQ6bpQ6hMT2nwWUnxY"
    "wnwbshMbsbpbsXkaER0 LIAUXGa9XnamYkYWZEWZaqQBY+QBXeWBW5YUV0Z4U4Z5TKZ5TKQBRkQBRknVVInVXInUZGkAZGgpZGeaYFbgAJTKkxTK"
    "cdVIcdWSccXcekXcgpXciqWSkwVIkx KKAoYkmlYkjhXqkWWElMVVlNUClMSpjMSphXSpf0TkeOU4dxV0dXXmcsZRZSZRWdZRTEXAPkUzPlT+PkS"
    "GQURGRDRGUTSETMT6SIUzSJWKSIXoUQXoWNXoX8WkZ4VXaXUaavSobcREecREhHREkMTPnwVKnxV+nwXrnK JyAIP9nVZ0nVZ0ktVsktVsQBUGQB"
    "UGktP9kt LuASRZnVS+nVS+ZLS+VaUWSIV3SJXYSIYvVaYvZLYvnVaUnVaUYxaUUMYEPkV3PlTqPkRZUMRZYx K8AHUlQBQInVRynVVeTtZLnVa0"
    "nVWYQB P0ANQinVSInVUlTpXCnVYznVbQTpdsnVfTnVcYQBaYQBX7kRVcQBTdQB K+AMRAnVStnVVmerYhnVaOnVWecJaeQBYxQBVfZ9SMQBQeQB"
    "Upcd JyAJP+nVRqnVU6dxYHnVZ0nVVsbJVsQBUGQBUGbJ K+AKQ6nVaEnVaEk9SsSraQSraQQBQuQBQuSbYGktQ6kt GQAIRYoVUsoVUsmFS0mFS"
    "0OBUsOBUsLzRYLz FZAERVnVVZNDUENDQAnV GQAIU4oVU4LzRkLzRkOBTbOBTbmFRkmFRkoV NaAHXenVbuepaJepWtk1TRepRsepV8nV IAAEY"
    "KKtYKIdP2IdP2Kt IAAES4pnVEjxT4jxRVpn J0ALVfY1TwY0SaXMSaVTSaTwTaR8USR9VeR8W6VWW6YLW6Y1AbYWaBYWQBW6QBW6SrWbREU9PkT"
    "5PlSjPkQ+SkQ+VHQ+YES8bEU6bFW6bFW6bVW6dUVnfgUcfhTsfgSQewRmeFRmgtSZhUT4h8Ulh9Weh8YWeA KKAMXyYxXyb6WffgVWfhUNfgS6b6"
    "S6YxS6VkUNR8VWR9WfR8XyVkARS6e3TWgaUvh8Vsh9XSh8ZSc4ZSYxZSUoXSPkVsPlUvPkTWRES6SpS6QBRdQBRdoVS6oV IzAaX0g1X0eJXMe0V"
    "+fgVWfhT8fgSab8SaYxSaViT8SAVWSBV+SAXMSqX0TVX0QtXNQIV6PkVMPlTOPkQ4UgQ4YxQ4dATPh8VSh9V8h8XOhY KKARXRe3XRoVYtoVYtQB"
    "XRQBXRSpW0REVcPkUePlS4PkQ4UoQ4YxQ4c4S4h8Ueh9Vch8W0gaAMSYYxSYVkTrR8U0R9V9R8XRVkXRYxXRb6V9fgU0fhTrfgSYb6 J2AVZAZfZ"
    "AYFSYYFSeVGUFSAVgSBWWSAX5S0YqTpYqQ5X4QQWQPkVbPlTVPkQ4UcQ4YlQ4c4TNh8VLh9W8h8ZAdYAHXkaVXicsWQfgVMfhT/fgSicwScaV Fo"
    "AUV8oVV8l9Ukl9Tyl8TMksTMjFTMhhVkhhVkfRTMfRTMQBRwQBRwfRQYfRQYhhRwhhRwivRwloTGoUUloV KKAMXRY9XRcEV+fgU0fhTqfgSYcES"
    "YY9SYV2TqSaU0SbV+SaXRV2AdYtSNYtNsWuJWUrJXT6JWSkJ0R8KRR8NFSkMYT0LuUcLvV3LuXROsXRRrXRTFW0RiVcQAUeQBS2QAQ4U6Q4Y9Q4d"
    "AS2h8Ueh9Vch8W0gYXRe3XRhhYthh KJAUYyalYyQBXWQBXWafXWc8WYfcVafdUQfcS6ccS6Z5S6QBRdQBRdoVS6oVS6ezTagYU0h8Vuh9XPh8Yy"
    "eM EcAERghhS8hhS8QBRgQBAERgoVS8oVS8ktRgkt EcAMRghhS8hhS8PtS8MWRrJWQQJXPuJXPuLzQGLzQ6LyRgNURgPtAERgoVS8oVS8ktRgkt"
    " JRALRdoVS6oVS6Z9XMhhZChhUYZVZOQBXWQBS6YlS6QBRdQB EcAERgoVS8oVS8QBRgQB PmAjYUeJY3gEaXh8bYh9cwh8eOeGeOaleOQBcyQBc"
    "yafcydAb5fca+fdZ3fcYkccYkZ5YkQBXIQBXIafXIdAWOfcVTfdUMfcS6ccS6Z5S6QBRdQBRdhhS6hhS6ezTZgYUxh8Vuh9Wqh8YAgA KJAUYyal"
    "YyQBXWQBXWafXWc8WYfcVafdUQfcS6ccS6Z5S6QBRdQBRdhhS6hhS6ezTagYU0h8Vuh9XPh8YyeM JyAMU6fhTwfgSab4SaYxSaVmTvSAU6SBWDS"
    "AXZVoXZYxXZb2WDfgAMU6h9Wyh8Y6dEY6YxY6UcWyPkU6PlTBPkQ4UcQ4YxQ4dETBh8 KKARS6SpS6JXRdJXRdhhS6hhS6e3TWgaUvh8Vsh9XSh8"
    "ZSc4ZSYxZSUoXSPkVsPlUvPkTWREAMXyYxXyb6WffgVWfhUNfgS6b6S6YxS6VkUNR8VWR9WfR8XyVk KKAMSYYxSYVkTrR8U0R9V9R8XRVkXRYxX"
    "Rb6V9fgU0fhTrfgSYb6ARXRSpW0REVcPkUePlS4PkQ4UoQ4YxQ4c4S4h8Ueh9Vch8W0gaXRe3XRhhYthhYtJXXRJX GlASWle1WWfGVxfYVbfZUN"
    "fYS6cMS6ZPS6QBRdQBRdhhS6hhS6ezTWgYU0h8V2h9WAh8WWh2Wkhx IWAoXGhBXGeRWee4VKfgUefhTZfgSUeMSUc5SUb4TGawUQaRUvaBWRZYX"
    "kW+XkU1XkSYVoPkT8PlTPPkRuQGQ4QpQ4TpRqSyTOR8T+R9U/R8WFTWWFUpWFVyVSXCT9XpTdX3SIYaQ8awQ8cxQ8fQSsh8USh9VGh8Wghc GSAU"
    "S8mfS8hhV5hhV5fRS8fRS8VxS8ToThSaUaSbV5SbV5QBUaQBSwQARfSgRfVxRffRQcfRQchhRfhhRfmf KJAURXW7RXhhSzhhSzXBSzUiTxSEUvS"
    "FV6SEXQVAXQXlXQhhYshhYsQBXQQBXQStWuRGVWPkUcPlS7PkRXTUABU+h9 JeAHQehhSAhhUvS1XehhZAhhVuQBTwQB NGANQrhhSHhhT6T3Vsh"
    "hXZhhZMT3a+hhcahhaIQBYcQBWjeXUqQBS+QB JeAMYyhhVoZBY8QBXQQBUtW5SKQBQeQBT3ZLQwhhSchhUxbRXGhh JeAQVKOZUiLQTYJWSaJXR"
    "RJXRRLxSHLxStLwTXM4TwO/UBQTQehhSAhhUvT1XehhZAhh IaAKQ4hhXuhhXue5SUSVXuSVXuQBQsQBQsSpWGfNQ4fN KMAlYMNDYMKzXsKzVwK"
    "yUcNGUcQlUcUTUcWoTmYcSeYdSAYdSAatSeatTmasUccgUce1UcilUcmAVwoUXsoVYMoVYMmFXqmFWjmEV4ksV4ihV4epV4cMVKZ8UUZlVLZIV4W"
    "8V4UhV4QpV4OaWjNCXqND FZAETXodTXIdSCIdSCod KMAlSANDSjNDTpNCUUOYUUQpUUUhUUW8VAZIV4ZlVAZ8UUcMUUepUUihUUkuTpmESjmFS"
    "AmFSAoVSgoVUcoUVwmAVwilVwe1VwcgWmasXsatYMatYMYdXsYdWmYcVwWoVwUTVwQlVwNGUcKySgKzSAKz NaAebucxbuaBa5YwZgXsYvXtX4Xs"
    "WvYpWqYsWnYtWkYwWcY1VOZ0UgZ1T0Z0SeYmRsXVRsaFShbUT6cYUrcZVicYWsbdWwbYWzbZW3bUW+bRYMaQY6aRZmaQa6bc FG GaAEUAdjSadj"
    "SahhUAhhAGUAKNSaKNSaUbSlaBT2aBUAUb KMAHVTSFVTfdUKfIS4boS4YxS4V2UKSUAbYSg1YSeJXseyWofcWGfhWGSBWpSEXuSuYSTVYSQtXxQ"
    "MWsPqWGPlWGLJVTLJVTPpTaP8RWUuRWYxRWcwTahkVTh5VTmZWGmZWGh5Wrh0XwhU KMAcYnm1Ynj/YBkoW9lQWelRVUlQUai0UafhUacLXecLXe"
    "Z9UaZ9UaSrYxSrYxQBRAQBRASrS2SrS2Z9RTZ9RTcLS2cLS2f5S2j8UinwWWnxW0nwYAnQ KMAkW+fhYlizZehBX3dxYKc2YcbAYcaBYcZCYIXQX"
    "0WXZdTJYkRXW8UlWfT8VlTYVGTZUqTYTuT8TPUhRoRTQvTFSWWVSEXQRyZIRyaBRybASEc0SYdtQwg9RqivTRfhTsgGUmgsVGgtVkgsWfgIAMXNa"
    "FXNb0WAeMVGeNUOeMTAb0TAaFTAYQUOV0VGV1V/V0XNYS KMAZZGXJV4XJV4QBUUQBUUXJREXJREZDUUZDUUZ1TqcRREcRREeNTIeNQpnVSInVVG"
    "cZYCnVZinVXCeNZGeNZGcRWhcRV3Z1V3ZDZGZD FZAETXWZTXKjSCKjSCWZAETXmZTXajSCajSCmZ IAAMS+epSed6R/cgR/bzR/amTEYgVCWbVh"
    "XIWAYiWAZRWAacU4ckAzWem3WekTV1k4UulgUSlhThlgSrkQSrjJSrhwUSf9UffsUmflWQduXRbUXRZxXRYUWjWIV0VVWUUgWwS0WwR1WwPkVKM8"
    "T0M9TPM8SCNaRWN5RWQdSCP0TMPMToPNUcPMVUQgVURtVUTUTmVPTZVdRuXUQuZsQubVQucuRce8SKfvRsgaRPiKRPjRRPlQSznwUGnxUqnwV3nU"
    " IAAEUvoRWUoRWUlHUvlHAERsoRTRoRTRlHRslH QAAYYAnNZMnMbQlgcGjzc8iEdyeAdybldyZMc8VIcGTdbQRuZMQAYAQBW0QAUwRuT6TdTEVI"
    "SOZMSOblSOeATEiET6jzUwlgW0nMAYYAlnW+lmVOkIUeirTwhMTAdoTAblTAZkTwWAUeUlVOTEW+RmYARnZCRma0TEbiUlcRWAdAZidAbldAdqcQ"
    "hMbiira0kIZClmAaaWhxaWfxZ0gQY0gwYSgxXIgwV0eCV0blV0ZGXKWYYYWZY4WYZ0W4aWXZaWVbZ0U8YwUgYMUhWgUgUjYUUjblUje2WgioYMip"
    "YxioZ1iM HiAERGZRWeZRWeXVRGXVAbWciNWcbNVSbNVSc9U8b+T0a6TGa7SGa6Q6dAQ6ezQ6g4SZjET3jFVSjFVSjJVSkiUYl8Tdl9S+l8R6lcR"
    "Yk5RYm5R8nUTFnwTonxVDnwWclAALUShRTChQSDgMSDe/SDd+S0cwTdcxURcwVSfAVSg1VShR JyAHYSglYSdlV8ZZYSVNYSSNUoYxUoaBAHU6gl"
    "U6dlSjZZU6VNU6SNRPYxRPaB NaAGRsdfbudfbuUhaaUhaaa1Rsa1 FyAEQyaFVAaFVAXhQyXh QAAYYAlnW+lmVOkIUeirTwhMTAdoTAblTAZkT"
    "wWAUeUlVOTEW+RmYARnZCRma0TEbiUlcRWAdAZidAbldAdqcQhMbiira0kIZClmAYYAnNZMnMbQlgcGjzc8iEdyeAdybldyZMc8VIcGTdbQRuZMQ"
    "AYAQBW0QAUwRuT6TdTEVISOZMSOblSOeATEiET6jzUwlgW0nMAJXygxW1gxW1cdXycdYqccZVdYZVelZVfwYpgwAUX2iXZOiWalggalenaldQZwb"
    "gZAbRZMbIZuZ6aFYxbKVTZ0VTYzYlYWaEXxa2XWa3W1a3W1VTVoVTVoiX IAAERqn3WWn3WWljRqlj IAAMUAlxTYlwShkAShixShhgTYf0UAf1U"
    "of0VfhgVfixVfkAUolwAPUAnxUgnwVbnAVwmRWIlkWejyWeixWegsVCd0T/d1S8d0RigoRiixRik2S+nw NaAMXXkFXXeBbueBbubZXXbZXXVVWD"
    "VVWDbZRsbZRseBWDeBWDkFAERsSrbuSrbuQBRsQB GaAZSGcPVacPVaadQvadQvcLRAcoRgdhUMiSUMjxUMkyTYmEStmFSTmERWlgQyk9Qym5RYn"
    "USbnwS4nxUAnwVXlsVXkBVXh0SydZSWco GaApUGhhU0hOVmfgVmeRVmcUUIaMSvaNSSaMRUaiQxa3QxcxRLcUSGb6Sob7Teb6UadIUaeRUafYTj"
    "gkStglSCglSCiRSxiRTgiQUQjQUQkNUQlGTemESvmFSbmERolwRAlbRAnNRkneSknwTAnxUInwVcl6VckZVcjSUvhy IAAEVGpnWppnUGjvS6jv "
    "KMAhRXJXRXhhSzhhSzWpSzUYT4SEU8SFWGSEXQUsXQXVXQhhYshhYsUDYsTGY+SMZQSNZUSMZkSYZySlZyQRZeP4Y6PkYoPlYGPkXcQwXVSBW8Qy"
    "V0PkVCPlUQPkTIQwSzSBSzJX KMAOU8nVYcnVYcM9XWM9XWlbV3lbV3M9UwM9UwaJTEaaRPd4RPgxRPjsTRnU FGAERudHTXdHTXZJRuZJ IAAUU"
    "qQBVGPCVgNYVgMpVgLQUkJ0TqJ1TSJ0SnKASSKNSSMRSiMATILwTfLxT8LwUaMgUaNPUaNsUFPETuQB GaALROcLS0cLS0ltRElFREm5S4nhT8nh"
    "T8cLVicLViadROad HiAERGZRWeZRWeXVRGXVAMTynxVLnwWykUWyhVWyeUVLa6Tya7SYa6QweWQwhVQwkUSYnwAMTyl9S9l8R+jcR+hVR+fQS+c"
    "wTycxUmcwVkfQVkhVVkjcUml8 JyAHRgglVLaBVLYxRgSNRgVNT3ZZRgdlAHU6glYkaBYkYxU6SNU6VNXQZZU6dl PgALROcLS0cLS0ltRElFREm"
    "5S4nhT8nhT8cLVicLViadROadADc0bLaaUpc0UpALcpdFd8dFd8UpfAUpfAS7d8S7d8QBc0QBc0S7ZlS7ZlU1AEaxnxcBnxUvPlTfPl PgALROcL"
    "S0cLS0ltRElFREm5S4nhT8nhT8cLVicLViadROadAZbMRzegRzegQBZ0QBZ0RvaGSMalTFdRX2dRZVdRaWcdbobybpbYboacbEZ4ahZ4cdaec4bg"
    "dUb9dVdGdUecbQecZlecXYb3S9bbSMAEaxnxcBnxUvPlTfPl PgApUGhhU0hOVmfgVmeRVmcUUIaMSvaNSSaMRUaiQxa3QxcxRLcUSGb6Sob7Teb"
    "6UadIUaeRUafYTjgkStglSCglSCiRSxiRTgiQUQjQUQkNUQlGTemESvmFSbmERolwRAlbRAnNRkneSknwTAnxUInwVcl6VckZVcjSUvhyADc0bLa"
    "aUpc0UpALcpdFd8dFd8UpfAUpfAS7d8S7d8QBc0QBc0S7ZlS7ZlU1AEaxnxcBnxUvPlTfPl IgAhT6bRVZbRVZY1VZXOU+VMUQT1TkSdTGRoStQK"
    "StPZStOATuMSUlMTVMMSWmNYXWOdXWLhWnKmVHJuUUJvS4JuRIMwRIPRRIQcRsSkSYT7TEVRTcWATwW0T0XNT3XiT6YeT6ZVAEVcdjT3djT3hhVc"
    "hh K8ADVekPTVYpXoYpAIUlnVWYnVa0QBZLQBYHWBS2WBRyQBQIQBAEVCttWkplVXplTktt K8ADVekPTVYpXoYpAIUlnVWYnVa0QBZLQBYHWBS2"
    "WBRyQBQIQBAEV6ttXWttVkplUYpl K8ADVekPTVYpXoYpAIUlnVWYnVa0QBZLQBYHWBS2WBRyQBQIQBAHUvttWNttX2plWxplVesVULplTGpl K8"
    "ADVekPTVYpXoYpAIUlnVWYnVa0QBZLQBYHWBS2WBRyQBQIQBAeVcqvVArRUzrcUkroUerpUMroT4q2T4qJT4qFS5qFS5roTsteUYtfUqteVItOVg"
    "s1V8sVWIsIWZr8Wgr9Wwr8XEswXEtZXEtfYDtfYCr6XOqEWkqFWUqEV2qU K8ADVekPTVYpXoYpAIUlnVWYnVa0QBZLQBYHWBS2WBRyQBQIQBAEW"
    "NtPXytPXyqFWNqFAETKtPUvtPUvqFTKqF K8AMWqpbWqqYV+ryVerzU+ryUSqcUSpbUSocU+nEVenFV+nEWqocADVekPTWYpXmYpATUSl1T0meTV"
    "oQTVpbTVrMUktsVettWXtsXorMXopbXooUXImeWql1a0QBZLQBYHWBS2WBRyQBQIQB PmAQeanVeaktYoktYodxeMdxeMbJYobJYoSrekSrekQBX"
    "CQBXCWBS6WBRqQBQEQBU8nVAEWCk5TdYpXCYpXCk5 LLAaaUljaUiNZgjsXtlKWslLUslKSkgQSkbpSkXCUsSIWsSJXtSIZgToaUVHaUR1ZeQsXo"
    "PkWmPlT8PkQ6WCQ6bpQ6hQT8nwWmnxXpnwZgmoAUXAQBXcPCX3NYX3MpX3LQW7J0WAJ1VpJ0U+KAUoKNUoMRU5MAVeLwV2LxWTLwWxMgWxNPWxNs"
    "WcPEWFQB KHAMRknVY8nVY8ktTKktTKdxYtdxYtbJTKbJTKSrZGSrZGQBRkQBAEUyttWUplVIplTVtt KHAMRknVY8nVY8ktTKktTKdxYtdxYtbJ"
    "TKbJTKSrZGSrZGQBRkQBAEVqttXHttVVplUIpl KHAMRknVY8nVY8ktTKktTKdxYtdxYtbJTKbJTKSrZGSrZGQBRkQBAHUgttV+ttXoplWiplVPs"
    "VT8plS2pl KHAMRknVY8nVY8ktTKktTKdxYtdxYtbJTKbJTKSrZGSrZGQBRkQBAEV+tPXktPXkqFV+qFAES6tPUgtPUgqFS6qF EuAERknVTKnVT"
    "KQBRkQBAER7ttTdplSQplQett EuAERknVTKnVTKQBRkQBAESzttUQttSeplRRpl EuAERknVTKnVTKQBRkQBAHRottTGttUwplTqplSYsVREplP"
    "/pl EuAERknVTKnVTKQBRkQBAETGtPUstPUsqFTGqFAEQDtPRotPRoqFQDqF MaANRqnVU6nVYSnUbdhsbdbtbdVqYSQAU6QBRqQBRqa9QFa9QFd"
    "NRqdNANTPkxTPdNV3dNV3a9TPa9TPSnVISnXjSmZyW+ZybtZygYXjkwVIkx L+AKRknVTsnVY4T1Y4nVaanVaaQBYSQBTGjhTGQBRkQBAeV9qvVg"
    "rRVUrcVEroU+rpUsroUYq2UYqJUYqFTaqFTaroUOteU4tfVKteVptOWBs1WesVWpsIW6r8XCr9XSr8XmswXmtZXmtfYktfYjr6XwqEXGqFW0qEWX"
    "qU MmAMWUlNUmlMSkgESkbpSkXQUmSIWUSJYCSIaCXQaCbpaCgEYClMAMWUnxYwnwbshMbsbpbsWIYwPkWUPlT2PkQ6WIQ6bpQ6hMT2nwAEV3ttX"
    "ZplWMplUatt MmAMWUlNUmlMSkgESkbpSkXQUmSIWUSJYCSIaCXQaCbpaCgEYClMAMWUnxYwnwbshMbsbpbsWIYwPkWUPlT2PkQ6WIQ6bpQ6hMT2"
    "nwAEWvttYMttWaplVNpl MmAMWUlNUmlMSkgESkbpSkXQUmSIWUSJYCSIaCXQaCbpaCgEYClMAMWUnxYwnwbshMbsbpbsWIYwPkWUPlT2PkQ6WIQ"
    "6bpQ6hMT2nwAHVkttXCttYsplXmplWUsVVAplT7pl MmAMWUlNUmlMSkgESkbpSkXQUmSIWUSJYCSIaCXQaCbpaCgEYClMAMWUnxYwnwbshMbsbp"
    "bsWIYwPkWUPlT2PkQ6WIQ6bpQ6hMT2nwAeWSqvV1rRVorcVZroVTrpVBroUtq2UtqJUtqFTuqFTuroUiteVNtfVfteV+tOWWs1WysVW+sIXOr8XW"
    "r9Xmr8X6swX6tZX6tfY4tfY4r6YEqEXaqFXJqEWsqU MmAMWUlNUmlMSkgESkbpSkXQUmSIWUSJYCSIaCXQaCbpaCgEYClMAMWUnxYwnwbshMbsb"
    "pbsWIYwPkWUPlT2PkQ6WIQ6bpQ6hMT2nwAEXCtPYotPYoqFXCqFAET/tPVktPVkqFT/qF NaAMbOhNXqaBbOS5aSRBWtYLTIRBSMS5VwaBSMhNTI"
    "jFWtb7aSjF MmAKZbhZT0ULUUTKVkSIWUSJYCSIaCXQaCbpaCdYZugQAKYyjJYUkIXDlMWUlNUmlMSkgESkbpSkZ4S4W8TLV5AYSITdRhVAQ6ZIQ"
    "6bpQ6hMT2nwWUnxXUnwZDmkZulZbAoZbym/aej5bEiQbseIbsbpbsWIYwPkWUPlVUPkTlQuS4R5RmO7QzQT LuASRZnVS+nVS+ZLS+VaUWSIV3SJ"
    "XYSIYvVaYvZLYvnVaUnVaUYxaUUMYEPkV3PlTqPkRZUMRZYxAEVattW8plVwplT9tt LuASRZnVS+nVS+ZLS+VaUWSIV3SJXYSIYvVaYvZLYvnVa"
    "UnVaUYxaUUMYEPkV3PlTqPkRZUMRZYxAEWSttXvttV9plUwpl LuASRZnVS+nVS+ZLS+VaUWSIV3SJXYSIYvVaYvZLYvnVaUnVaUYxaUUMYEPkV3"
    "PlTqPkRZUMRZYxAHVIttWmttYQplXKplV3sVUkplTepl LuASRZnVS+nVS+ZLS+VaUWSIV3SJXYSIYvVaYvZLYvnVaUnVaUYxaUUMYEPkV3PlTqP"
    "kRZUMRZYxAEWmtPYMtPYMqFWmqFAETitPVItPVIqFTiqF JyAJP+nVRqnVU6dxYHnVZ0nVVsbJVsQBUGQBUGbJAEVVttWyttVAplTzpl JsANRkn"
    "VTKnVTKjNVIjNXGjMZGfsZGcRZGY0XGVSVIVTTKVTTKQBRkQBAJTKgpTKX5VIX5WPX4XcaKXccRXceWWQgoVIgp KFAwRdhxRdk4TUoUVCoVWqoU"
    "YXksYYhNXNhEV5fQV5dxV5dCWWbwW2bJXTajYmY4ZWWqZWVHZWSaXmPkV8PlVcPkUYP8T0QVT0S5UcSaViR8WCR9W8R8X4TcX4U5X4V2XaXKWoYJ"
    "V6ZBVKZ6UecAUeddUefcVyiIW+ilW6kMV4l8VAl9T+l8S6jwS6htS6QBRdQB J0ALVfY1TwY0SaXMSaVTSaTwTaR8USR9VeR8W6VWW6YLW6Y1AbY"
    "WaBYWQBW6QBW6SrWbREU9PkT5PlSjPkQ+SkQ+VHQ+YES8bEU6bFW6bFW6bVW6dUVnfgUcfhTsfgSQewRmeFRmgtSZhUT4h8Ulh9Weh8YWeAAETgp"
    "nVujxUhjxR+pn J0ALVfY1TwY0SaXMSaVTSaTwTaR8USR9VeR8W6VWW6YLW6Y1AbYWaBYWQBW6QBW6SrWbREU9PkT5PlSjPkQ+SkQ+VHQ+YES8bE"
    "U6bFW6bFW6bVW6dUVnfgUcfhTsfgSQewRmeFRmgtSZhUT4h8Ulh9Weh8YWeAAEVupnXSpnUvjvTijv J0ALVfY1TwY0SaXMSaVTSaTwTaR8USR9V"
    "eR8W6VWW6YLW6Y1AbYWaBYWQBW6QBW6SrWbREU9PkT5PlSjPkQ+SkQ+VHQ+YES8bEU6bFW6bFW6bVW6dUVnfgUcfhTsfgSQewRmeFRmgtSZhUT4h"
    "8Ulh9Weh8YWeAAHUEpnVOpnXIjvWDjvUpnlTPjvSKjv J0ALVfY1TwY0SaXMSaVTSaTwTaR8USR9VeR8W6VWW6YLW6Y1AbYWaBYWQBW6QBW6SrWb"
    "REU9PkT5PlSjPkQ+SkQ+VHQ+YES8bEU6bFW6bFW6bVW6dUVnfgUcfhTsfgSQewRmeFRmgtSZhUT4h8Ulh9Weh8YWeAAcUnlbUKmRUAmkTvm4Tom5"
    "TWm4TElwTCkdSEkdSFmkS4o4Tmo5T4o4UYocUrn7VInFVSmwVjmcVqmdV8mcWOnkWQo5XOo5XNmwWakcVskdVakcU6k4 J0ALVfY1TwY0SaXMSaV"
    "TSaTwTaR8USR9VeR8W6VWW6YLW6Y1AbYWaBYWQBW6QBW6SrWbREU9PkT5PlSjPkQ+SkQ+VHQ+YES8bEU6bFW6bFW6bVW6dUVnfgUcfhTsfgSQewR"
    "meFRmgtSZhUT4h8Ulh9Weh8YWeAAEVYoRW+oRW+lHVYlHAESUoRT6oRT6lHSUlH J0ALVfY1TwY0SaXMSaVTSaTwTaR8USR9VeR8W6VWW6YLW6Y1"
    "AbYWaBYWQBW6QBW6SrWbREU9PkT5PlSjPkQ+SkQ+VHQ+YES8bEU6bFW6bFW6bVW6dUVnfgUcfhTsfgSQewRmeFRmgtSZhUT4h8Ulh9Weh8YWeAAM"
    "V1n1V1o0VJqMUpqNUIqMTdo0Tdn1Tdm0UIlcUpldVJlcV1m0AMWyn1WymAVijgUpjhTwjgSgmASgn1SgpoTwsGUpsHVisGWypo PuAHdbaVdacsc"
    "IfgbEfhZ3fgYacwYUaVAtXyfFYWgcaAh8bCh9c0h8e4dYe4Zfe4YFYQYFYWVEZ8R8bYR9cMR8dwSyeiTpeiQ5dwQQcIPkbTPlaAPkYERcXdTVW4R"
    "cVMPkUFPlSmPkQ+SeQ+VHQ+YES8bEU6bFW6bFW6bVW6dUVnfgUcfhTsfgSQewRmeFRmgtSZhUT4h8Ulh9Vsh8XWgcALVfY1TwY0SaXMSaVTSaTwT"
    "aR8USR9VeR8W6VWW6YLW6Y1 IzAaX0g1X0eJXMe0V+fgVWfhT8fgSab8SaYxSaViT8SAVWSBV+SAXMSqX0TVX0QtXNQIV6PkVMPlTOPkQ4UgQ4Yx"
    "Q4dATPh8VSh9V8h8XOhYAUVyQBWNPCWoNYWoMpWoLQVsJ0UxJ1UaJ0TuKATZKNTZMRTqMAUPLwUmLxVELwViMgViNPViNsVMPEU2QB J2AVZAZfZ"
    "AYFSYYFSeVGUFSAVgSBWWSAX5S0YqTpYqQ5X4QQWQPkVbPlTVPkQ4UcQ4YlQ4c4TNh8VLh9W8h8ZAdYAHXkaVXicsWQfgVMfhT/fgSicwScaVAET"
    "9pnWKjxU+jxSapn J2AVZAZfZAYFSYYFSeVGUFSAVgSBWWSAX5S0YqTpYqQ5X4QQWQPkVbPlTVPkQ4UcQ4YlQ4c4TNh8VLh9W8h8ZAdYAHXkaVXi"
    "csWQfgVMfhT/fgSicwScaVAEWLpnXupnVMjvT/jv J2AVZAZfZAYFSYYFSeVGUFSAVgSBWWSAX5S0YqTpYqQ5X4QQWQPkVbPlTVPkQ4UcQ4YlQ4c"
    "4TNh8VLh9W8h8ZAdYAHXkaVXicsWQfgVMfhT/fgSicwScaVAHUgpnVqpnXljvWgjvVGnlTsjvSmjv J2AVZAZfZAYFSYYFSeVGUFSAVgSBWWSAX5"
    "S0YqTpYqQ5X4QQWQPkVbPlTVPkQ4UcQ4YlQ4c4TNh8VLh9W8h8ZAdYAHXkaVXicsWQfgVMfhT/fgSicwScaVAEV0oRXaoRXalHV0lHAESxoRUWoR"
    "UWlHSxlH EcAERGpnTTjxSGjxPkpnAERghhS8hhS8QBRgQBABSOh9 EcAETUpnU4pnSUjvRIjvAERghhS8hhS8QBRgQBABSOh9 EcAERghhS8hhS"
    "8QBRgQBABSOh9AHRqpnS0pnUujvTojvSOnlQ0jvPvjv EcAERghhS8hhS8QBRgQBABSOh9AES+oRUjoRUjlHS+lHAEP6oRRgoRRglHP6lH JyAPW"
    "jeVWKekVee0VKe1T2e0SabcSaYZSaVcTwSAU6SBWCSAXZVcXZYZXZaUW+dQAaXCh1YCfmY6bGY6YZY6UaWsPkU6PlTGPkQ4UaQ4YZQ4cUTChKUxh"
    "LU6hKVUhEVphBUaj1R6iJRqjtT2lJScoVUOoVVNmFX0nzYEmRVwkx KJAUYyalYyQBXWQBXWafXWc8WYfcVafdUQfcS6ccS6Z5S6QBRdQBRdhhS6"
    "hhS6ezTagYU0h8Vuh9XPh8YyeMAcVKlbUumRUimkUSm4UMm5T4m4TmlwTmkdSnkdSomkTbo4UIo5Uco4U8ocVOn7VqnFV2mwWGmcWMmdWgmcWynk"
    "Wyo5Xxo5XwmwW9kcWQkdV8kcVck4 JyAMU6fhTwfgSab4SaYxSaVmTvSAU6SBWDSAXZVoXZYxXZb2WDfgAMU6h9Wyh8Y6dEY6YxY6UcWyPkU6PlT"
    "BPkQ4UcQ4YxQ4dETBh8AETxpnV+jxUyjxSOpn JyAMU6fhTwfgSab4SaYxSaVmTvSAU6SBWDSAXZVoXZYxXZb2WDfgAMU6h9Wyh8Y6dEY6YxY6Uc"
    "WyPkU6PlTBPkQ4UcQ4YxQ4dETBh8AEV/pnXipnVAjvTzjv JyAMU6fhTwfgSab4SaYxSaVmTvSAU6SBWDSAXZVoXZYxXZb2WDfgAMU6h9Wyh8Y6d"
    "EY6YxY6UcWyPkU6PlTBPkQ4UcQ4YxQ4dETBh8AHUUpnVepnXZjvWUjvU6nlTgjvSajv JyAMU6fhTwfgSab4SaYxSaVmTvSAU6SBWDSAXZVoXZYx"
    "XZb2WDfgAMU6h9Wyh8Y6dEY6YxY6UcWyPkU6PlTBPkQ4UcQ4YxQ4dETBh8AcU4lbUbmRUQmkUAm4T5m5Tmm4TUlwTTkdSUkdSWmkTIo4T2o5UJo4"
    "UpocU8n7VYnFVjmwV0mcV6mdWNmcWfnkWgo5Xeo5XemwWqkcV9kdVqkcVKk4 JyAMU6fhTwfgSab4SaYxSaVmTvSAU6SBWDSAXZVoXZYxXZb2WDf"
    "gAMU6h9Wyh8Y6dEY6YxY6UcWyPkU6PlTBPkQ4UcQ4YxQ4dETBh8AEVooRXOoRXOlHVolHAESloRUKoRUKlHSllH NaAEVwhxXqhxXqd5Vwd5AEVw"
    "WNXqWNXqSXVwSXAERsbZbubZbuYtRsYt JyAKXEchTRTRTmSoUZSAU6SBWDSAXZVoXZYxXZZ+XPb0AKWheNWMe2VYfgU6fhTufgSab0SaYhSaXYS"
    "jVsStU9AYRuSnRUT0Q4W4Q4YxQ4dETBh8U6h9Voh8W4hIXZgVYei9ZOhtYFe7YgdsY6aoY6YxY6UcWyPkU6PlUKPkS5QYSaRLRUOjQkPx KJAURX"
    "W7RXhhSzhhSzXBSzUiTxSEUvSFV6SEXQVAXQXlXQhhYshhYsQBXQQBXQStWuRGVWPkUcPlS7PkRXTUABU+h9AET1pnWCjxU2jxSSpn KJAURXW7R"
    "XhhSzhhSzXBSzUiTxSEUvSFV6SEXQVAXQXlXQhhYshhYsQBXQQBXQStWuRGVWPkUcPlS7PkRXTUABU+h9AEWDpnXmpnVEjvT3jv KJAURXW7RXhh"
    "SzhhSzXBSzUiTxSEUvSFV6SEXQVAXQXlXQhhYshhYsQBXQQBXQStWuRGVWPkUcPlS7PkRXTUABU+h9AHUYpnVipnXdjvWYjvU+nlTkjvSejv KJA"
    "URXW7RXhhSzhhSzXBSzUiTxSEUvSFV6SEXQVAXQXlXQhhYshhYsQBXQQBXQStWuRGVWPkUcPlS7PkRXTUABU+h9AEVsoRXSoRXSlHVslHAESpoRU"
    "OoRUOlHSplH JeAQVKOZUiLQTYJWSaJXRRJXRRLxSHLxStLwTXM4TwO/UBQTQehhSAhhUvT1XehhZAhhAEV0pnXYpnU1jvTojv KKARS6SpS6JXR"
    "dJXRdoVS6oVS6e3TWgaUvh8Vsh9XSh8ZSc4ZSYxZSUoXSPkVsPlUvPkTWREAMXyYxXyb6WffgVWfhUNfgS6b6S6YxS6VkUNR8VWR9WfR8XyVk Je"
    "AQVKOZUiLQTYJWSaJXRRJXRRLxSHLxStLwTXM4TwO/UBQTQehhSAhhUvT1XehhZAhhAEVeoRXEoRXElHVelHAESaoRUAoRUAlHSalH";

namespace {

constexpr double units = 1024.0;

/// Reads the numbers of a glyph.
class GlyphReader {
 public:
  explicit GlyphReader(std::string_view digits) : digits_(digits) {}
  bool ended() const { return at_ >= digits_.size(); }
  int number() {
    const int high = digit(digits_[at_]);
    const int low = digit(digits_[at_ + 1]);
    at_ += 2;
    return high * 64 + low;
  }

 private:
  static int digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    return c == '+' ? 62 : 63;
  }
  std::string_view digits_;
  std::size_t at_ = 0;
};

constexpr std::size_t glyph_count = 95 + 96;

std::array<std::string_view, glyph_count> all_glyphs() {
  std::array<std::string_view, glyph_count> glyphs;
  std::string_view rest = letter_outlines;
  for (std::string_view& glyph : glyphs) {
    glyph = rest.substr(0, rest.find(' '));
    rest.remove_prefix(std::min(rest.size(), glyph.size() + 1));
  }
  return glyphs;
}

std::string_view glyph_of(char latin1) {
  static const std::array<std::string_view, glyph_count> glyphs = all_glyphs();
  const auto code = static_cast<unsigned char>(latin1);
  return glyphs[code < 0x80U ? code - 0x20U : code - 0xa0U + 95U];
}

struct CurvePoint {
  Vec2 at;
  bool on = false;
};

/// The contour in chords: between two points off the curve lies one on it, half-way.
std::vector<Vec2> contour_of(const std::vector<CurvePoint>& points) {
  constexpr int chords = 4;
  std::vector<Vec2> contour;
  const std::size_t n = points.size();
  const auto middle = [](Vec2 a, Vec2 b) { return 0.5 * (a + b); };
  for (std::size_t i = 0; i < n; ++i) {
    const CurvePoint& here = points[i];
    if (here.on) {
      contour.push_back(here.at);
      continue;
    }
    const CurvePoint& before = points[(i + n - 1) % n];
    const CurvePoint& after = points[(i + 1) % n];
    const Vec2 a = before.on ? before.at : middle(before.at, here.at);
    const Vec2 b = after.on ? after.at : middle(here.at, after.at);
    for (int k = before.on ? 1 : 0; k < chords; ++k) {
      const double t = static_cast<double>(k) / chords;
      contour.push_back((1 - t) * (1 - t) * a + 2 * t * (1 - t) * here.at + t * t * b);
    }
  }
  return contour;
}

/// Cut at the blanks that stand behind one of these letters; none: at all blanks.
std::vector<std::string> parts_between(const std::string& text, std::string_view behind) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    std::string& last = parts.back();
    if (c == ' ' && (behind.empty() || (!last.empty() && behind.find(last.back()) != std::string_view::npos))) {
      parts.emplace_back();
    } else {
      last += c;
    }
  }
  return parts;
}

}  // namespace

std::string latin1_text(std::string_view text) {
  std::string latin1;
  while (!text.empty()) {
    const std::size_t bytes = utf8_bytes(text);
    const auto byte = [&](std::size_t i) { return static_cast<unsigned>(static_cast<unsigned char>(text[i])); };
    unsigned code = '?';
    if (bytes == 1) code = byte(0);
    if (bytes == 2) code = (byte(0) & 0x1fU) << 6 | (byte(1) & 0x3fU);
    const bool known = (code >= 0x20U && code < 0x7fU) || (code >= 0xa0U && code <= 0xffU);
    latin1 += known ? static_cast<char>(code) : '?';
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return latin1;
}

double text_width(std::string_view text, double size) {
  int width = 0;
  for (const char c : latin1_text(text)) width += GlyphReader(glyph_of(c)).number();
  return width * size / units;
}

PolygonSet text_outlines(std::string_view text, double size) {
  PolygonSet outlines;
  double pen = 0.0;
  const double scale = size / units;
  std::vector<CurvePoint> points;
  for (const char c : latin1_text(text)) {
    GlyphReader glyph(glyph_of(c));
    const int advance = glyph.number();
    while (!glyph.ended()) {
      points.clear();
      for (int count = glyph.number(); count > 0; --count) {
        const int x = glyph.number() - 1024;
        const int y = glyph.number();
        points.push_back({{pen + scale * x, -scale * (y / 2 - 512)}, y % 2 == 1});
      }
      outlines.add(contour_of(points));
    }
    pen += scale * advance;
  }
  return outlines;
}

std::string fitting_text(const std::string& text, double size, double width) {
  if (text_width(text, size) <= width) return text;
  std::string short_text = text;
  while (!short_text.empty() && text_width(short_text + "...", size) > width) {
    do short_text.pop_back();
    while (!short_text.empty() && utf8_bytes(std::string_view(text).substr(short_text.size())) == 0);
  }
  return short_text + "...";
}

std::string fitting_ends(const std::string& text, double size, double width) {
  const auto inside = [&](std::size_t at) {
    return at < text.size() && (static_cast<unsigned char>(text[at]) >> 6) == 2;
  };
  for (std::size_t kept = text.size(); kept > 0; --kept) {
    std::size_t begin = (kept + 1) / 2;
    std::size_t end = text.size() - kept / 2;
    while (inside(begin)) --begin;  // no letter is cut
    while (inside(end)) ++end;
    std::string ends = kept == text.size() ? text : text.substr(0, begin) + "..." + text.substr(end);
    if (text_width(ends, size) <= width) return ends;
  }
  return "...";
}

std::vector<std::string> wrapped_text(const std::string& text, double size, double width) {
  if (text.empty()) return {};
  std::vector<std::string> lines(1);
  const auto add = [&](const std::string& part) {
    std::string& line = lines.back();
    const std::string longer = line.empty() ? part : line + ' ' + part;
    if (line.empty() || text_width(longer, size) <= width) {
      line = longer;
    } else {
      lines.push_back(part);
    }
  };
  for (const std::string& part : parts_between(text, ",;")) {
    const auto words = text_width(part, size) <= width ? std::vector{part} : parts_between(part, "");
    for (const std::string& word : words) add(word);
  }
  for (std::string& some : lines) some = fitting_text(some, size, width);
  return lines;
}

}  // namespace warren
